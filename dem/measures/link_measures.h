#pragma once

#include "dem/measures/loads.h"
#include "dem/model/held_lines.h"
#include "dem/model/link_law.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <array>

namespace dem
{
  /** Which positions belong to the links' forces and state. */
  enum class Geometry
  {
    before_motion, ///< those of before the last step's motion: between steps, when particles have moved on
    present        ///< the present ones: within a step, between link pass and particle pass
  };

  /** A link at the instant t_n of the last force evaluation: particles have moved on since, the link's state and force have not. */
  struct LinkView
  {
    Eigen::Vector3d direction; ///< n, from first to second end
    double          length;    ///< [m]
    double          strain;    ///< normal strain [-]
    Eigen::Vector3d force;     ///< on the first end [N]
  };

  inline LinkView link_at(const Particles  &particles,
                          const LinkSet    &links,
                          const std::size_t link,
                          const Geometry    geometry = Geometry::before_motion)
  {
    const auto moved = [&](const std::int32_t i) {
      return Eigen::Vector3d(&particles.motion[record_size * static_cast<std::size_t>(i)]);
    };
    LinkView view;
    view.direction = branch_of(particles, links, link);
    if (geometry == Geometry::before_motion)
      {
        view.direction -= moved(links.second[link]) - moved(links.first[link]);
        if (links.periodic)
          view.direction -= particles.cell.motion_of(links.image[link]);
      }
    view.length = view.direction.norm();
    view.direction /= view.length;
    view.strain = (view.length - links.reference_length[link]) / links.reference_length[link];
    view.force  = Eigen::Vector3d(&links.force[record_size * link]);
    return view;
  }

  /** The same as what measures of stress and couple stress take. */
  LinkLoad load_at(const Particles &particles, const LinkSet &links, std::size_t link);

  /** One link after the other as its law wants it: geometry and history. */
  class LinkReader
  {
  public:
    LinkReader(const Particles &particles_, const LinkSet &links_, const LinkLaw &law_)
      : particles(particles_)
      , links(links_)
      , law(law_)
    {
    }
    LinkReader(Particles &&, const LinkSet &, const LinkLaw &) = delete;

    /** Go to a link. */
    void read(std::size_t link, Geometry at = Geometry::before_motion);

    const LinkGeometry &geometry() const { return place; }
    const LinkView     &view() const { return seen; }
    const double       *history() const { return row.data(); }

    /** What the law says of the link that was read last; see LinkLaw. */
    double                     stored() const { return law.stored(pair, place, row.data()); }
    double                     damage_dissipation() const { return law.damage_dissipation(pair, place, row.data()); }
    LinkLoss                   damage() const { return law.damage(pair, place, row.data()); }
    LinkPhase                  phase() const { return law.phase(pair, place, row.data()); }
    std::vector<BrokenElement> broken_elements() const
    {
      return law.broken_elements(pair, place, seen.direction, row.data());
    }
    LinkStiffnesses stiffness() const { return law.stiffness(pair, place, row.data()); }
    /** The largest that it can have: closed, if that makes a difference. */
    LinkStiffnesses closed_stiffness() const
    {
      LinkGeometry closed = place;
      closed.strain       = -1;
      return law.stiffness(pair, closed, row.data());
    }
    /**
     * The same as an explicit step sees it; of a law that stiffens, with the two this much nearer to each other than they are [m].
     */
    LinkStiffnesses stiffness_of_step(const double ahead) const
    {
      LinkGeometry closed = place;
      closed.strain       = law.stiffens() ? std::min(place.strain, 0.0) - ahead / place.reference : -1;
      return law.stiffness_of_step(pair, closed, row.data());
    }
    LinkStiffnesses damaged_stiffness() const { return law.damaged_stiffness(pair, place, row.data()); }
    LinkExertion    exertion() const { return law.exertion(pair, place, seen.direction, seen.force, row.data()); }

  private:
    const Particles    &particles;
    const LinkSet      &links;
    const LinkLaw      &law;
    LinkView            seen;
    LinkGeometry        place;
    std::size_t         pair = 0; ///< of materials
    std::vector<double> row;
  };

  /**
   * Work that its ends would have done on a link in the half step before t_n by the force (and moment) that the link pass has found
   * at t_n [J]. A link that is deleted at t_n does not take it up: it never had this part of what it is thought to store.
   */
  double work_not_taken_up(const Particles &particles, const LinkSet &links, const LinkView &link, std::size_t number);

  /** Power that particles put into living links by their velocities, those about a periodic cell's motion [W]. */
  double power_of_ends(const Particles &particles, const LinkSet &links);

  /** Energy that all living links would store at this normal strain, undamaged [J]. */
  double energy_of_strain(const Particles &particles, const LinkSet &links, const LinkLaw &law, double strain);

  /** Energy stored in all living links [J]. */
  double elastic_energy(const Particles &particles, const LinkSet &links, const LinkLaw &law);
  /** Add that of some lines to a sum, one after the other. */
  void add_elastic_energy(
    const Particles &particles, const LinkSet &links, const LinkLaw &law, const LinkRange &lines, double &sum);

  /** Dissipated by damage of the links so far, as the pass has summed it up: of laws that have no closed form for it [J]. */
  double summed_damage(const LinkSet &links);
  /** What links store, and what damage has dissipated in them [J]. */
  using LinkEnergies = std::array<double, 2>;
  /** Add both of some living links to their sums, damage by the closed form of the law, where it has one. */
  void add_energies(
    const Particles &particles, const LinkSet &links, const LinkLaw &law, const LinkRange &lines, LinkEnergies &sums);

  /** Dissipated by sliding since the start [J]. */
  double plastic_dissipation(const LinkSet &links);
  /** Dissipated by dashpots since the start [J]. */
  double viscous_dissipation(const LinkSet &links);
  /** Set free since the start by bonds that broke in their place [J]. */
  double released_in_place(const LinkSet &links);

  /**
   * Call use(particle, moment) for the share of each living link among some lines in the stress moments V_P sigma_P = sum (c - x_P) (x) f_on_P [N m]
   * of both its ends, c the contact point (Love-Weber; doc/theory/stress-and-fabric.md, 1).
   */
  template <typename Use>
  void each_stress_moment(const Particles &particles, const LinkSet &links, const LinkRange &lines, const Use &use)
  {
    each_living(links, lines, [&](const std::size_t l) {
      const LinkView    view = link_at(particles, links, l);
      const std::size_t J = links.first[l], K = links.second[l];
      const double      eccentric = particles.radius_of(J) - particles.radius_of(K);
      const auto        moment    = view.direction * view.force.transpose();
      use(J, Eigen::Matrix3d(0.5 * (view.length + eccentric) * moment));
      use(K, Eigen::Matrix3d(0.5 * (view.length - eccentric) * moment)); // both arm and force change sign
    });
  }
} // namespace dem
