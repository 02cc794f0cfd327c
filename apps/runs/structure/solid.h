#pragma once

#include "apps/runs/continuum/probe_column.h"
#include "apps/runs/coupled/particle_medium.h"
#include "apps/runs/structure/model.h"
#include "coupling/promotion/place_motion.h"
#include "dem/network/loaded_hinges.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace apps
{
  /** The solid around the particles of a structure, whatever the dimension. */
  class StructureSolid
  {
  public:
    virtual ~StructureSolid() = default;

    /** Particles and joints, tied. */
    virtual const dem::LoadedNetwork &network() const = 0;

    virtual std::vector<ProbeColumn> columns() const                             = 0;
    virtual std::vector<double>      read(const dem::LoadedMotion &motion) const = 0;

    /** Of each place its motion; none where it lies in no element. */
    virtual coupling::PlaceMotions       motions_at(const std::vector<Eigen::Vector3d> &places,
                                                    const dem::LoadedMotion            &motion) const = 0;
    virtual std::vector<Eigen::Vector3d> joint_places() const                              = 0;
    /** Of nodes whose displacement is prescribed, or on which a load acts [m]. */
    virtual std::vector<Eigen::Vector3d> burdened_nodes() const = 0;

    /** Links with an end in the overlap of each handshake, in the scene's order. */
    virtual std::vector<std::vector<std::size_t>> shared_links() const = 0;
    /** StaticHandshake::is_positive() */
    virtual bool is_positive() const = 0;
    /** Particles whose weight is left out, as no equilibrium would bear it (dem::unload_hinges()). */
    virtual const std::vector<dem::Mechanism> &swinging() const = 0;
    virtual Eigen::Vector3d                    weight() const   = 0; ///< of the solid, as far as it counts [N]
    virtual std::size_t                        elements() const = 0;
    virtual std::size_t                        unknowns() const = 0;
    virtual std::size_t                        joints() const   = 0;

    /** Largest difference of a material's stiffness from that of the particles in its place, over its norm. */
    virtual double difference_from(const ParticleMedia &media) const = 0;

    /** Whole, by one rank. @param number of the snapshot @throws postprocess::OutputError */
    virtual void write(const std::filesystem::path &folder,
                       std::size_t                  number,
                       double                       time,
                       const dem::LoadedMotion     &motion) const = 0;

    /** Corners of its elements in the plane of a picture, displacements magnified. @param across axis of the picture, found here */
    virtual std::vector<std::vector<Eigen::Vector2d>>
    outlines(const dem::LoadedMotion &motion, double magnify, int &across) const = 0;
  };

  /** @param handshakes between both @param particles held and driven. The model must outlive the solid. @throws base::InputError */
  std::unique_ptr<StructureSolid>
  surround(const StructureModel &model, const HandshakesSection &handshakes, dem::LoadedNetwork particles);
} // namespace apps
