#include "coupling/volume/volume_coupling.h"

#include "base/errors.h"
#include "coupling/volume/bond_shares.h"
#include "coupling/volume/gaps.h"
#include "coupling/volume/overlapping_particles.h"
#include "dem/model/particles.h"
#include "fem/solid/point_search.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  template <int dim>
  VolumeCoupling<dim>::VolumeCoupling(dem::Specimen                  &specimen_,
                                      const fem::Solid<dim>          &solid_,
                                      fem::ExplicitSolver<dim>       &motion_,
                                      SolidParticipant<dim>          &participant_,
                                      const VolumeCouplingParameters &parameters)
    : specimen(specimen_)
    , solid(solid_)
    , motion(motion_)
    , participant(participant_)
    , own(parameters)
    , node_map(solid_, participant_)
    , turns(solid_.options().large_displacement && parameters.method != VolumeMethod::multipliers)
    , far(solid_.options().large_displacement)
    , predicted(solid_.make_vector())
  {
    refuse_order_2_where_masses_are_negative();
    find_particles();
    share();
    if (own.method == VolumeMethod::multipliers)
      {
        weigh_nodes();
        tie(1);
      }
    else
      find_stiffness_of_constrained();
    if (own.absorbs)
      make_absorber();
    place_nodes();
    shared_bonds = count_shared_bonds().first;
  }

  template <int dim>
  void VolumeCoupling<dim>::refuse_order_2_where_masses_are_negative() const
  {
    const bool by_rows = own.lumped || own.method != VolumeMethod::multipliers;
    if (by_rows && solid.options().degree > 1)
      throw base::InputError(
        "Handshakes/" + own.name +
        ": elements of order 2 have shape functions that are negative in places. Lumped ties divide by sums of "
        "them, and constrained particles hand masses on by them, which are not positive then. Take Method = "
        "multipliers "
        "with Ties = coarse or strict, or elements of order 1.");
  }

  namespace
  {
    /** Loose ones are the last. */
    std::size_t number_of_bonded(const dem::ObservedSpecimen &specimen)
    {
      const std::size_t all = specimen.counts().particles;
      return all - std::min(specimen.parameters().loose, all);
    }
  } // namespace

  template <int dim>
  bool VolumeCoupling<dim>::lies_in_solid(const Vector3d &place) const
  {
    dealii::Point<dim> where;
    for (int c = 0; c < dim; ++c)
      where[c] = place[c];
    return solid.point_search().find(where).has_value();
  }

  template <int dim>
  void VolumeCoupling<dim>::find_particles()
  {
    std::vector<Vector3d> all;
    for (std::size_t i = 0; i < specimen.counts().particles; ++i)
      all.push_back(specimen.particle(i).position);
    const std::size_t bonded = number_of_bonded(specimen);
    std::vector<bool> inside(all.size(), false);
    for (const std::size_t i :
         overlapping_particles({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(bonded)}, own,
                               [this](const Vector3d &place) { return lies_in_solid(place); }))
      inside[i] = true;
    refuse_gaps(solid, bonded_particles(specimen), own);
    std::vector<std::size_t>
      beside; // in the absorber's layer; at its start nothing is damped, and one-sided averages do not matter
    // In the specimen's own order: neighbours are next to each other in memory.
    for (const std::int32_t number : dem::hilbert_order(all))
      {
        const auto   i        = static_cast<std::size_t>(number);
        const double distance = own.overlap.distance(all[i]);
        if (inside[i])
          {
            node_map.enter(all[i]);
            watched.push_back(i);
          }
        else if (i < bonded && own.absorbs && distance < 0 && distance > -own.layer)
          beside.push_back(i);
      }
    overlapping   = watched.size();
    at_particles  = node_map.take();
    overlap_nodes = static_cast<Index>(node_map.nodes().size());
    watched.insert(watched.end(), beside.begin(), beside.end());
    for (const std::size_t i : watched)
      places.push_back(all[i]);
  }

  template <int dim>
  void VolumeCoupling<dim>::share()
  {
    const auto rows = static_cast<Index>(watched.size());
    whole_mass.resize(rows);
    for (Index k = 0; k < rows; ++k)
      whole_mass[k] = specimen.particle(watched[static_cast<std::size_t>(k)]).mass;
    if (own.method == VolumeMethod::multipliers)
      {
        std::vector<double>   masses;
        const BondedParticles all = bonded_particles(specimen);
        for (const BondShare &bonds : bond_shares(all, own.overlap))
          masses.push_back(bonds.whole > 0 ? bonds.sum / bonds.whole : 1.0);
        const std::vector<double> found =
          parts_within(all, own.overlap, {watched.begin(), watched.begin() + static_cast<std::ptrdiff_t>(overlapping)});
        parts = Eigen::Map<const Eigen::VectorXd>(found.data(), static_cast<Index>(found.size()));
        specimen.partners().share([this](const Vector3d &place) { return share_of_bonds(own.overlap, place); }, masses);
      }
    else
      leave();
    mass = inverse_mass = CarrierRows::Zero(rows, 3);
    for (Index k = 0; k < rows; ++k)
      {
        const dem::ParticleState p = specimen.particle(watched[static_cast<std::size_t>(k)]);
        for (int c = 0; c < dim; ++c)
          {
            mass(k, c)         = p.mass;
            inverse_mass(k, c) = p.held[static_cast<std::size_t>(c)] ? 0.0 : 1 / p.mass;
          }
      }
  }

  template <int dim>
  void VolumeCoupling<dim>::leave()
  {
    if (own.method == VolumeMethod::legacy)
      return specimen.partners().leave(watched, true);
    const std::vector<double> beside = find_bond_ends();
    specimen.partners().leave(watched, false);
    for (const Entry &e : at_particles)
      if (const double riding = e.weight * whole_mass[static_cast<Index>(e.row)] * beside[e.row]; riding > 0)
        for (const auto dof : participant.displacements(node_map.nodes()[e.node]))
          motion.add_mass(dof, riding);
  }

  template <int dim>
  std::vector<double> VolumeCoupling<dim>::find_bond_ends()
  {
    const dem::ElasticNetwork network = specimen.network();
    ends = bond_ends(network, watched, own.overlap, [this](const Vector3d &place) { return lies_in_solid(place); });
    for (const BondEnd &end : ends)
      {
        node_map.enter(end.from);
        node_map.enter(end.to);
      }
    at_ends = node_map.take();
    if (!turns)
      of_bond_ends = stiffness_of(ends, at_ends, node_map.nodes().size(), [](const Entry &e) { return e.node; });

    // Mass goes with the bonds, half of each to its constrained particle: beyond what lies in elements, which have it already.
    const std::vector<BondShare> made = bond_shares(bonded_particles(specimen), own.overlap);
    std::vector<double>          halves(network.particles(), 0);
    std::vector<bool>            constrained(network.particles(), false);
    for (const std::size_t i : watched)
      constrained[i] = true;
    for (const dem::ElasticLink &link : network.links)
      if (constrained[link.first] != constrained[link.second])
        halves[static_cast<std::size_t>(constrained[link.first] ? link.first : link.second)] += 1;
    for (const BondEnd &end : ends)
      halves[end.constrained] -= 2 * end.part;
    std::vector<double> beside;
    for (const std::size_t i : watched)
      beside.push_back(halves[i] > 0 ? halves[i] / made[i].whole : 0.0);
    return beside;
  }

  template <int dim>
  void VolumeCoupling<dim>::weigh_nodes()
  {
    const auto &nodes = node_map.nodes();
    node_mass = inverse_node_mass = CarrierRows::Zero(static_cast<Index>(nodes.size()), 3);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int c = 0; c < dim; ++c)
        {
          const auto   dof                    = participant.displacements(nodes[k])[static_cast<std::size_t>(c)];
          const double m                      = motion.mass()[dof];
          node_mass(static_cast<Index>(k), c) = m;
          inverse_node_mass(static_cast<Index>(k), c) = motion.force_for_velocity(dof, 1) > 0 ? 1 / m : 0.0;
        }
    velocity = CarrierRows::Zero(node_mass.rows(), 3);
  }

  template <int dim>
  void VolumeCoupling<dim>::place_nodes()
  {
    undeformed = CarrierRows::Zero(node_mass.rows(), 3);
    for (std::size_t k = 0; k < node_map.nodes().size(); ++k)
      undeformed.row(static_cast<Index>(k)) = participant.place(node_map.nodes()[k]);
  }

  template <int dim>
  void VolumeCoupling<dim>::find_stiffness_of_constrained()
  {
    weigh_nodes();
    constrained_now.turn.resize(overlapping);
    Eigen::VectorXd seen = Eigen::VectorXd::Zero(node_mass.rows());
    for (const Entry &e : at_particles)
      seen[static_cast<Index>(e.node)] += e.weight * specimen.stiffness_around(watched[e.row]);
    added = seen.cwiseProduct(inverse_node_mass.col(0)).maxCoeff();
  }

  template <int dim>
  CarrierRows VolumeCoupling<dim>::of_nodes(const fem::Vector &field) const
  {
    const auto &nodes  = node_map.nodes();
    CarrierRows values = CarrierRows::Zero(static_cast<Index>(nodes.size()), 3);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int c = 0; c < dim; ++c)
        values(static_cast<Index>(k), c) = field[participant.displacements(nodes[k])[static_cast<std::size_t>(c)]];
    return values;
  }

  template <int dim>
  void VolumeCoupling<dim>::begin(const double length)
  {
    window = length;
    motion.predict(window, predicted);
    from     = of_nodes(motion.velocity());
    to       = of_nodes(predicted);
    velocity = from;
    path     = CarrierRows::Zero(from.rows(), 3);
    if (far || of_bond_ends.nonZeros() > 0)
      displaced = of_nodes(motion.displacement());
    gone             = 0;
    turn_given       = Vector3d::Zero();
    impulse_together = impulse_absorber = impulse_double_counted = CarrierRows::Zero(from.rows(), 3);
  }

  template <int dim>
  void VolumeCoupling<dim>::correct(dem::StepCorrection &correction, const std::size_t first)
  {
    const double step = 2 * correction.half_after;
    if (own.method == VolumeMethod::multipliers)
      {
        tie(window / step);
        const CarrierRows before = from + gone / window * (to - from);
        gone += step;
        velocity = from + gone / window * (to - from);
        keep_together(correction, first, before);
      }
    else
      {
        if (gone == 0) // its own forces act at once: spread over the window they would act too late, and feed it
          velocity += to - from;
        drive(correction, first);
        path += step * velocity;
        gone += step;
      }
  }

  template <int dim>
  std::vector<const double *>
  VolumeCoupling<dim>::push_nodes(const dem::StepCorrection &correction, const std::size_t first, const double kick)
  {
    CarrierRows impulse = CarrierRows::Zero(velocity.rows(), 3);
    // Most constrained particles lie deeper in the elements than bonds to free particles reach, and carry no load.
    std::vector<const double *> pulls(overlapping, nullptr);
    for (std::size_t k = 0; k < overlapping; ++k)
      if (const double *pull = correction.force(first + k);
          std::any_of(pull, pull + axes, [](const double f) { return f != 0; }))
        pulls[k] = pull;
    for (const Entry &e : at_particles)
      if (const double *pull = pulls[e.row])
        {
          const Vector3d force(pull), couple(pull + 3);
          impulse.row(static_cast<Index>(e.node)) +=
            kick * (e.weight * force + constrained_now.turn[e.row].force_of(couple, e.gradient));
        }
    CarrierRows again = CarrierRows::Zero(impulse.rows(), 3); // what bonds bear in elements
    if (of_bond_ends.nonZeros() > 0)
      {
        const CarrierRows now             = displaced + path;
        again.reshaped<Eigen::RowMajor>() = kick * (of_bond_ends * now.reshaped<Eigen::RowMajor>());
      }
    else if (turns && !ends.empty())
      again = kick * slopes_of(ends, at_ends, nodes_now(), dim);
    impulse += again;
    impulse_double_counted += again;
    impulse_together += impulse;
    velocity += inverse_node_mass.cwiseProduct(impulse);
    if (turns)
      {
        const CarrierRows now = nodes_now();
        for (Index k = 0; k < now.rows(); ++k)
          exchanged.turn_to_solid += Vector3d(now.row(k)).cross(Vector3d(impulse.row(k)));
      }
    return pulls;
  }

  template <int dim>
  void VolumeCoupling<dim>::move_constrained(dem::StepCorrection &correction, const std::size_t first)
  {
    const auto rates = [&](const std::size_t k) { return &correction.velocity[axes * (first + k)]; };
    for (std::size_t k = 0; k < overlapping; ++k)
      std::fill_n(rates(k), axes, 0.0);
    for (const Entry &e : at_particles)
      {
        const Vector3d v = velocity.row(static_cast<Index>(e.node));
        Eigen::Map<Vector3d>{rates(e.row)} += e.weight * v;
        if (!turns)
          Eigen::Map<Vector3d>{rates(e.row) + 3} += 0.5 * e.gradient.cross(v);
      }
    if (!turns)
      return;
    // As far as elements will have turned at the end of the step: particles then have turned with them, however far.
    const double    step = 2 * correction.half_after;
    const PlacesNow then = places_now(at_particles, overlapping, nodes_now() + step * velocity, dim);
    for (std::size_t k = 0; k < overlapping; ++k)
      Eigen::Map<Vector3d>{rates(k) + 3} =
        rotation_between(constrained_now.turn[k].rotation, then.turn[k].rotation) / step;
  }

  template <int dim>
  void VolumeCoupling<dim>::keep_account_of_constrained(const dem::StepCorrection         &correction,
                                                        const std::size_t                  first,
                                                        const std::vector<const double *> &pulls)
  {
    const double kick    = correction.half_before + correction.half_after;
    const auto   rate_of = [first](const base::Column &column, const std::size_t k, const std::size_t part) {
      return Vector3d(&column[axes * (first + k) + part]);
    };
    for (std::size_t k = 0; k < overlapping; ++k)
      {
        if (!pulls[k])
          continue;
        const Vector3d force(pulls[k]), couple(pulls[k] + 3), given = -kick * force;
        for (const std::size_t part : {std::size_t(0), std::size_t(3)})
          exchanged.work_on_particles -= Vector3d(pulls[k] + part)
                                           .dot(correction.half_before * rate_of(correction.before, k, part) +
                                                correction.half_after * rate_of(correction.velocity, k, part));
        exchanged.to_particles += given;
        exchanged.turn_to_particles += (turns ? constrained_now.place[k] : places[k]).cross(given) - kick * couple;
      }
  }

  template <int dim>
  void VolumeCoupling<dim>::drive(dem::StepCorrection &correction, const std::size_t first)
  {
    if (turns)
      constrained_now = places_now(at_particles, overlapping, nodes_now(), dim);
    const auto pulls = push_nodes(correction, first, correction.half_before + correction.half_after);
    move_constrained(correction, first);
    keep_account_of_constrained(correction, first, pulls);
  }

  template <int dim>
  void VolumeCoupling<dim>::finish()
  {
    const auto &nodes = node_map.nodes();
    // Constrained particles have moved nodes within the window; multipliers have spread their impulses over it.
    const bool apart = own.method != VolumeMethod::multipliers && !path.isApprox(window * velocity);
    if (own.method == VolumeMethod::multipliers && far)
      keep_turning();
    exchanged.turn_to_particles += turn_given;
    if (own.method == VolumeMethod::multipliers)
      velocity = to + inverse_node_mass.cwiseProduct(impulse_together + impulse_absorber);
    const CarrierRows mean = 0.5 * (from + velocity);
    exchanged.work_on_solid += impulse_together.cwiseProduct(mean).sum();
    exchanged.double_counted += impulse_double_counted.cwiseProduct(mean).sum();
    exchanged.absorbed -= impulse_absorber.cwiseProduct(mean).sum();
    const CarrierRows impulse = impulse_together + impulse_absorber, places_of_nodes = far ? nodes_now() : undeformed;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      {
        const auto     row    = static_cast<Index>(k);
        const Vector3d change = inverse_node_mass.row(row).cwiseProduct(impulse.row(row)), given = impulse.row(row);
        Vector3d       force = Vector3d::Zero();
        for (int c = 0; c < dim; ++c)
          force[c] = change[c] * motion.force_for_velocity(
                                   participant.displacements(nodes[k])[static_cast<std::size_t>(c)], window);
        if (!force.isZero(0))
          participant.add_force(nodes[k], force);
        for (int c = 0; c < dim && apart; ++c)
          motion.carry(participant.displacements(nodes[k])[static_cast<std::size_t>(c)], path(row, c));
        exchanged.to_solid += given;
        if (!turns)
          exchanged.turn_to_solid += Vector3d(places_of_nodes.row(row)).cross(given);
      }
  }

  template <int dim>
  std::pair<std::size_t, std::size_t> VolumeCoupling<dim>::count_shared_bonds() const
  {
    const dem::LinkOutput links = specimen.links();
    std::vector<bool>     inside(specimen.counts().particles, false);
    for (std::size_t k = 0; k < overlapping; ++k)
      inside[watched[k]] = true;
    std::size_t all = 0, hurt = 0;
    for (std::size_t l = 0; l < links.ends.size(); ++l)
      if (links.kind[l] != dem::LinkOutput::contact && (inside[links.ends[l][0]] || inside[links.ends[l][1]]))
        {
          ++all;
          hurt += links.kind[l] == dem::LinkOutput::broken || links.damage[l] > 0;
        }
    return {all, hurt};
  }

  template <int dim>
  std::size_t VolumeCoupling<dim>::damaged_bonds() const
  {
    if (counted_at != specimen.steps())
      {
        damaged    = count_shared_bonds().second;
        counted_at = specimen.steps();
      }
    return damaged;
  }

  template <int dim>
  void VolumeCoupling<dim>::visit_state(base::StateVisitor &visitor)
  {
    const std::string name = "volumes/" + own.name + "/";
    for (int c = 0; c < 3; ++c)
      {
        const std::string axis = std::to_string(c);
        visitor.scalar(name + "to_particles_" + axis, exchanged.to_particles[c]);
        visitor.scalar(name + "to_solid_" + axis, exchanged.to_solid[c]);
        visitor.scalar(name + "turn_to_particles_" + axis, exchanged.turn_to_particles[c]);
        visitor.scalar(name + "turn_to_solid_" + axis, exchanged.turn_to_solid[c]);
      }
    visitor.scalar(name + "work_on_particles", exchanged.work_on_particles);
    visitor.scalar(name + "work_on_solid", exchanged.work_on_solid);
    visitor.scalar(name + "absorbed", exchanged.absorbed);
    visitor.scalar(name + "twice", exchanged.double_counted);
    visitor.scalar(name + "waited", waited);
    visitor.scalar(name + "steps_waited", steps_waited);
  }

  template class VolumeCoupling<2>;
  template class VolumeCoupling<3>;
} // namespace coupling
