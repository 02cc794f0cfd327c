#pragma once

#include "base/matrix6.h"
#include "base/state.h"
#include "dem/grips/grip_layers.h"
#include "dem/network/dead_load.h"
#include "dem/network/elastic_body.h"
#include "dem/network/elastic_network.h"
#include "dem/network/ties.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace dem
{
  /**
   * A network with all that moves it from outside: up to six load parameters, each of which moves the ends of links against each
   * other in proportion. In a periodic cell they are the macroscopic strains; of a gripped specimen the first is the strain between
   * the grips. One of them is driven; of the others some are free (their force vanishes), the rest stay zero.
   *
   * It may be joined to an elastic body: the carriers of motions are the particles and then the body's joints, which only translate.
   */
  struct LoadedNetwork
  {
    ElasticNetwork           network;
    std::vector<HeldMotions> held; ///< of each carrier: what its own motion leaves to the load parameters
    std::vector<Eigen::Matrix<double, 3, 6>> load_slip; ///< of each link: slip per unit of each parameter [m]
    /** Displacement of each particle per unit of each parameter, beyond its own motion [m]. */
    std::vector<Eigen::Matrix<double, 3, 6>> carried;
    std::array<bool, 6>                      free   = {};
    int                                      driven = 0;
    double                                   volume = 0; ///< force of a parameter over it is its stress [m^3]
    std::optional<ElasticBody>               body;
    std::optional<DeadLoad>                  dead; ///< stays while the driven parameter grows; none: nothing does
    std::shared_ptr<const Ties>              ties; ///< between carriers; none: nothing is tied
  };

  /** A free network that nothing moves yet; its stress is the force of the driven parameter. @throws base::InputError for a periodic one */
  LoadedNetwork unloaded(ElasticNetwork network);

  /** Particles that are driven along one of their motions: so much per unit of the driven parameter; nothing: they are held. */
  void drive(LoadedNetwork &loaded, const std::vector<std::size_t> &particles, int motion, double per_unit);

  /** Particles that are drawn down. @param weight of each particle [N] @pre all particles that are driven are so already */
  void weigh_down(LoadedNetwork &loaded, const std::vector<Eigen::Vector3d> &weight);

  /**
   * The same network, along whose path its dead load is put on.
   * @param released the load parameter that was driven is free meanwhile, and bears nothing; otherwise it stays zero
   * @pre there is a dead load
   */
  LoadedNetwork with_load_put_on(LoadedNetwork loaded, bool released);

  /**
   * A periodic cell strained along an axis; with `lateral_free` the other five stresses vanish, else the other five strains do.
   * One particle is held, so that the cell stays in place; nothing acts on it.
   *
   * @throws base::InputError if the network is not periodic, or the axis leaves a plane network
   */
  LoadedNetwork load_cell(ElasticNetwork network, int axis, bool lateral_free);

  /** A periodic cell whose strains are all given: none free, the first driven. @throws base::InputError if the network is not periodic */
  LoadedNetwork strained_cell(ElasticNetwork network);

  /** Two layers of particles that are driven apart (or together) along an axis, half of the way each. */
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
    CarrierMotions particles; ///< of each, and of each joint of a body, its own
    base::Vector6  loads;     ///< load parameters

    /** @param n number of carriers */
    explicit LoadedMotion(const std::size_t n = 0)
      : particles(CarrierMotions::Zero(motions, static_cast<Eigen::Index>(n)))
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
    CarrierMotions particles; ///< force [N] and moment [N m] on each carrier, zero where held or borne by ties
    base::Vector6  loads;     ///< force of each parameter, volume times its stress [J]
    double         borne = 0; ///< by links and body: root of the sum of squares of their forces [N]
    /** Of the forces on carriers, and of free parameters; over what is borne, both as root of sums of squares. */
    double residual = 0;
  };

  /** Displacements of the body's joints, three each [m]. @pre there is a body */
  Eigen::VectorXd joints_of(const LoadedNetwork &loaded, const LoadedMotion &motion);

  /**
   * @param force of each link on its first end [N]
   * @param moment likewise at the contact point [N m]; empty: there are none
   * @param scale length that makes forces of moments [m]
   * @param least that is taken for borne where less is: what has broken altogether bears nothing that a residual could be part of [N]
   */
  Unbalanced unbalanced_of(const LoadedNetwork                &loaded,
                           const LoadedMotion                 &motion,
                           const std::vector<Eigen::Vector3d> &force,
                           const std::vector<Eigen::Vector3d> &moment,
                           double                              scale,
                           double                              least = 0);

  /** Mean arm of the links: the length that makes forces of moments [m]. */
  double mean_arm(const ElasticNetwork &network);
} // namespace dem
