#pragma once

#include "coupling/promotion/place_motion.h"
#include "coupling/volume/mesh_elements.h"
#include "dem/statics/damaging_links.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace coupling
{
  /** Where a region of particles inside a solid starts, and what may become part of it. */
  struct GrowingRegion
  {
    std::string                                    name;      ///< of its handshake, for messages
    std::function<double(const Eigen::Vector3d &)> distance;  ///< from the region at the start, negative inside [m]
    double                                         width = 0; ///< of the overlap around it [m]
    double threshold = 0; ///< exertion of a bond at which its element follows [-]; 0: none does
    double reach     = 0; ///< how far from the region at the start elements may follow [m]

    bool grows() const { return threshold > 0; }
  };

  /** Regions of particles that elements of a mesh join once bonds inside them come near their damage (doc/theory/static-handshake.md, 4). */
  class GrowingRegions
  {
  public:
    using Set = MeshElements::Set;

    GrowingRegions(std::unique_ptr<MeshElements> mesh, std::vector<GrowingRegion> regions);

    /** Elements nearer to such places than the overlap is wide stay elements, e.g. beside nodes that something else holds [m]. */
    void leave_out_around(const std::vector<Eigen::Vector3d> &places);

    /** @param particles motions of places of all particles @throws base::InputError for an element without a particle that may follow */
    void require_particles(const PlaceMotions &particles) const;

    /**
     * Elements in which a bond has come near its damage follow. @param particles motion of each particle's place in the solid
     * @param bonds between these particles, evaluated. @return whether any has followed
     */
    bool
    grow(const dem::DamagingLinks &bonds, const std::vector<dem::ElasticLink> &links, const PlaceMotions &particles);

    /** Distance from a region as it is now, negative inside [m]. @throws base::InputError as MeshElements::distance_from() */
    std::function<double(const Eigen::Vector3d &)> distance_from(std::size_t region) const;

    std::vector<std::size_t> growable() const; ///< elements that may follow, by region
    std::vector<std::size_t> grown() const;    ///< elements that have followed, by region

    const std::vector<Set> &now() const { return region; }
    void                    set_now(std::vector<Set> elements) { region = std::move(elements); }
    bool                    has_grown() const { return region != first; }

  private:
    std::unique_ptr<MeshElements> mesh;
    std::vector<GrowingRegion>    regions;
    std::vector<Set>              first, may, region; ///< by region: at the start, those that may follow, now
  };
} // namespace coupling
