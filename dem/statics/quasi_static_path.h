#pragma once

#include "dem/statics/damaging_links.h"
#include "dem/statics/link_relaxation.h"
#include "dem/statics/tangent_system.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
  /** Two groups of particles whose distance along an axis, as it grows, may lead a path. */
  struct LeadingOpening
  {
    std::vector<std::size_t> group, other; ///< the second may have none: what is measured is a displacement
    int                      axis = 0;
    double                   step = 0; ///< from one point of the path to the next [m], > 0
    double                   end  = 0; ///< from where the path begins to where it ends at the latest [m], >= step

    /** Mean displacement of the group against the other [m]. */
    double of(const LoadedNetwork &loaded, const LoadedMotion &motion) const;
  };

  /** How a loaded network is driven along its equilibrium path, without any inertia. */
  struct QuasiStaticParameters
  {
    double sign = 1; ///< +1: tension, -1: compression

    double strain_step = 0;   ///< largest of the driven strain [-], > 0
    double growth_step = 0.2; ///< largest growth of any link's damaging strain in a step, over itself, in (0, 1]
    double end_strain  = 0;   ///< magnitude of the driven strain at which to stop [-], >= strain_step
    double end_stress  = 0.5; ///< stop when the stress has fallen to this part of its peak, in [0, 1)

    std::optional<LeadingOpening> leading; ///< in place of what both of the steps above say; none: these lead

    double tolerance      = 1e-7;        ///< see Unbalanced::residual, in (0, 1e-2]
    int    max_iterations = 12;          ///< of Newton's method on one step, > 1; three times as many with the secant
    LinkRelaxationParameters relaxation; ///< its tolerance is the one above

    SolverMethod solver = SolverMethod::direct; ///< of linear systems, see TangentSolver
    Ranks *ranks = nullptr; ///< that share an iteration, all of them following the same path; none: this process alone
  };

  /** What kept a step on the path. */
  enum class StepControl
  {
    strain,  ///< the driven strain was prescribed
    opening, ///< the largest growth of a crack opening was: it cannot but grow, though stress and strain may fall
    leading, ///< the opening that the parameters name was
    relaxed, ///< no equilibrium near by was found; the driven strain was held and dynamics found the next one (a cascade)
    changed ///< the driven strain was held while another network took the place of the one before
  };

  std::string name_of(StepControl control);

  /** One equilibrium of the path, with the energy of the whole path so far. */
  struct QuasiStaticPoint
  {
    base::Vector6 strain      = base::Vector6::Zero(); ///< load parameters [-]
    base::Vector6 stress      = base::Vector6::Zero(); ///< [Pa]
    double        mean_damage = 0;

    double external_work =
      0;               ///< trapezoidal over the points: where damage jumps it errs in proportion to the steps [J]
    double stored = 0; ///< in links, and in the body around them [J]
    double damage = 0, friction = 0; ///< dissipated by damage and by sliding [J]
    double damped  = 0; ///< dissipated by the damping of relaxations: kinetic energy that cascades set free [J]
    double changed = 0; ///< brought in where another network took the place of the one before [J]

    StepControl  control          = StepControl::strain;
    int          iterations       = 0; ///< linear solutions, those of attempts that failed too
    std::int64_t relaxation_steps = 0;
    double       residual         = 0; ///< see Unbalanced::residual

    double energy_residual() const { return external_work + changed - stored - damage - friction - damped; }
    /** Over the work (or what was dissipated, if that is more); 0 at the start. */
    double balance_error() const;
  };

  /**
   * Equilibrium path of a network of links of any law under a growing driven strain, past the peak (doc/theory/quasi-static-path.md).
   *
   * Newton's method with the consistent tangent, the secant where it fails. Steps are controlled by the strain as long as damage
   * grows slowly, and otherwise indirectly (de Borst, 1987, Comput. Struct. 25, 211) by the largest growth of a crack opening in the
   * whole network, which is monotone by construction; so that snap-back is followed. Between the two directions along the path the
   * one is taken in which the links that damaged last go on damaging. A step that does not converge is shortened; one that is then
   * too small is left to relax_links(), and the path says so.
   *
   * The network must outlive the path. Same input, same bits, for any number of threads.
   */
  class QuasiStaticPath
  {
  public:
    /** @throws base::InputError for parameters out of range. */
    QuasiStaticPath(const LoadedNetwork         &loaded,
                    const LinkMaterials         &materials,
                    const QuasiStaticParameters &parameters);

    /** One point further. @throws base::NumericalError if even the relaxation finds no equilibrium. */
    const QuasiStaticPoint &advance();
    bool                    finished() const;

    /**
     * Goes on where a path of the same network, along which another parameter was driven, has come to. What ends this one counts from there.
     */
    void go_on_where(const QuasiStaticPath &earlier);

    /**
     * Goes on from where the path of another network has come to: its points, the history of the links that both have, and then one point
     * more, the equilibrium of this network under the same driven strain.
     * @param start motion to find it from, which obeys this network's ties
     * @param before the number there of each link of this network; none: it is new, and undamaged
     * @throws base::NumericalError as advance()
     */
    const QuasiStaticPoint &go_on_from(const QuasiStaticPath                         &earlier,
                                       const LoadedMotion                            &start,
                                       const std::vector<std::optional<std::size_t>> &before);

    /** The driven parameter, counted from where the path began to drive it. */
    double driven_since_start() const { return driven() - origin; }

    const std::vector<QuasiStaticPoint> &points() const { return path; } ///< from the start, all zero
    const DamagingLinks                 &links() const { return bonds; }
    const LoadedMotion                  &motion() const { return now; }

    /** Everything to go on to the same bits. */
    void visit_state(base::StateVisitor &visitor);

  private:
    struct Target
    {
      StepControl control;
      double      strain = 0; ///< driven, to be reached
      double      growth = 0; ///< largest of a link, to be reached
      double      width  = 0; ///< of the leading opening, to be reached [m]
    };

    /** A step of the driven parameter with the sign that goes on along the path. */
    Target choose(const TangentSystem::Answer &answer, double part) const;
    Target choose_by_opening(const TangentSystem::Answer &answer, double part) const;
    bool   is_led() const { return parameters.leading.has_value(); }
    /** Steps of the driven parameter at which the largest growth is as given: below, above. */
    std::pair<double, double> steps_to(double growth, const TangentSystem::Answer &answer) const;
    bool                      attempt(LinkStiffness stiffness, double part);
    bool                      iterate(LinkStiffness stiffness, const Target &target);
    double                    correction(const Target &target, const TangentSystem::Answer &answer) const;
    void                      relax(double onward);
    void                      accept(StepControl control);
    void                      complete(QuasiStaticPoint &point);
    void                      restore(const LoadedMotion &earlier);
    void                      visit_points(base::StateVisitor &visitor);
    double                    work_of_dead_loads() const;
    double                    stored() const;      ///< in links, and in the body around them, now [J]
    double                    least_borne() const; ///< that residuals are part of [N]
    /** Of the driven parameter, to where the path ends. */
    double strain_left() const { return parameters.end_strain - parameters.sign * (driven() - origin); }
    double driven() const { return now.loads[loaded->driven]; }
    double width(const LoadedMotion &motion) const { return parameters.leading->of(*loaded, motion); }

    const LoadedNetwork          *loaded;
    QuasiStaticParameters         parameters;
    DamagingLinks                 bonds;
    TangentSystem                 system;
    LoadedMotion                  now;
    Unbalanced                    unbalanced;
    std::vector<QuasiStaticPoint> path;
    double                        part           = 1; ///< of the largest steps, in use
    int                           solutions      = 0; ///< since the last point
    StepControl                   control        = StepControl::strain;
    int                           attempt_length = 0; ///< iterations of the last attempt
    double                        dead_load_work = 0; ///< up to the last point [J]
    double                        most_borne     = 0; ///< of all points: Unbalanced::borne [N]
    double                        origin         = 0; ///< driven parameter from which the end counts
    double                        width_before   = 0; ///< leading opening likewise [m]
  };
} // namespace dem
