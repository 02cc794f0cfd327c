#pragma once

#include "base/matrix6.h"
#include "base/state.h"
#include "dem/grips/grip_layers.h"
#include "dem/statics/elastic_network.h"
#include "dem/statics/stiffness_operator.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace dem
{

  /**
   * A network with all that moves it from outside: up to six load parameters, each of which moves the ends of links against each
   * other in proportion. In a periodic cell they are the macroscopic strains; of a gripped specimen the first is the strain between
   * the grips. One of them is led; of the others some are free (their force vanishes), the rest stay zero.
   */
  struct LoadedNetwork
  {
    ElasticNetwork           network;
    std::vector<HeldMotions> held; ///< of each particle: what its own motion leaves to the load parameters
    std::vector<Eigen::Matrix<double, 3, 6>> load_slip; ///< of each link: slip per unit of each parameter [m]
    /** Displacement of each particle per unit of each parameter, beyond its own motion [m]. */
    std::vector<Eigen::Matrix<double, 3, 6>> carried;
    std::array<bool, 6>                      free   = {};
    int                                      led    = 0;
    double                                   volume = 0; ///< force of a parameter over it is its stress [m^3]
  };

  /**
   * A periodic cell strained along an axis; with `lateral_free` the other five stresses vanish, else the other five strains do.
   * One particle is held, so that the cell stays in place; nothing acts on it.
   *
   * @throws base::InputError if the network is not periodic, or the axis leaves a plane network
   */
  LoadedNetwork load_cell(ElasticNetwork network, int axis, bool lateral_free);

  /** A periodic cell whose strains are all given: none free, the first led. @throws base::InputError if the network is not periodic */
  LoadedNetwork strained_cell(ElasticNetwork network);

  /** Two layers of particles that are led apart (or together) along an axis, half of the way each. */
  struct GripPair
  {
    int        axis = 2;
    GripLayers layers;
    bool       lateral_blocked = false; ///< their particles cannot move sideways
    bool       spin_blocked    = false; ///< nor rotate
  };

  /**
   * A free network between two grips; load parameter 0 is the strain, its stress the mean of both grips' forces over the section.
   * @throws base::InputError for empty or overlapping grips, or a length or section that is not above zero
   */
  LoadedNetwork load_grips(ElasticNetwork network, const GripPair &grips);

  /**
   * Motions that nothing else prevents of a specimen between grips that hold only along their axis: sideways translations and the
   * rotation about the axis. They are held at particles of the low grip (three, two in the plane), which costs no force.
   */
  void support(LoadedNetwork &loaded, const GripPair &grips);

  /** Small motion of a loaded network. */
  struct LoadedMotion
  {
    Eigen::Matrix<double, 6, Eigen::Dynamic> particles; ///< of each its own displacement [m] and rotation [-]
    base::Vector6                            loads;     ///< load parameters

    explicit LoadedMotion(const std::size_t n = 0)
      : particles(Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, static_cast<Eigen::Index>(n)))
      , loads(base::Vector6::Zero())
    {
    }
    void visit_state(base::StateVisitor &visitor);
  };

  /** Relative displacement of the two ends at the contact point of a link [m]; doc/theory/statics.md, 1. */
  Eigen::Vector3d slip_of(const LoadedNetwork &loaded, std::size_t link, const LoadedMotion &motion);

  /** Relative rotation of the two ends of a link, second less first [rad]. */
  Eigen::Vector3d turn_of(const LoadedNetwork &loaded, std::size_t link, const LoadedMotion &motion);

  /** What link forces leave over. */
  struct Unbalanced
  {
    Eigen::Matrix<double, 6, Eigen::Dynamic> particles; ///< force [N] and moment [N m] on each, zero where held
    base::Vector6                            loads;     ///< force of each parameter, volume times its stress [J]
    double                                   residual =
      0; ///< of the forces on particles, and of free parameters; over link forces, both as root of sums of squares
  };

  /**
   * @param force of each link on its first end [N]
   * @param moment likewise at the contact point [N m]; empty: there are none
   * @param scale length that makes forces of moments [m]
   */
  Unbalanced unbalanced_of(const LoadedNetwork                &loaded,
                           const std::vector<Eigen::Vector3d> &force,
                           const std::vector<Eigen::Vector3d> &moment,
                           double                              scale);

  /** Mean arm of the links: the length that makes forces of moments [m]. */
  double mean_arm(const ElasticNetwork &network);
} // namespace dem
