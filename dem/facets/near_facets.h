#pragma once

#include "dem/facets/shared_surfaces.h"
#include "dem/facets/surface.h"
#include "dem/model/particles.h"

#include <cstdint>
#include <vector>

namespace dem
{
  /** A facet that a particle may touch. */
  struct NearFacet
  {
    std::int32_t surface, facet;
    double       gap; ///< when the list was made [m]; negative: within the particle's search radius
  };

  /**
   * Which facets are near which particles: no pair is visited while nothing can touch.
   *
   * Proof by distance, as of contacts between particles (doc/theory/contacts.md): `path` is the sum over steps of the largest
   * displacement of any particle plus that of any vertex. A pair cannot come nearer by more than that, so (1) the list of pairs nearer
   * than a margin is complete until `path` reaches the margin, and (2) a pair need not be visited before `path` reaches its gap.
   *
   * Lists are made from a grid of the particles of each size class (radii within a factor of two), each facet visiting the cells
   * around it: linear in both. Of several ranks each looks around its own particles, and all have the lists of one.
   */
  class NearFacets
  {
  public:
    /** Largest displacements of the last step [m]. */
    void moved(const double of_particles, const double of_vertices) { path += of_particles + of_vertices; }
    /** Whether any pair can touch now. */
    bool can_touch() const { return stale || path >= next_update; }
    /** Whether update() would read more particles than those of the lists. */
    bool reads_all() const { return can_touch() && (stale || path >= margin); }
    /** Make the lists good for where everything is now. @pre can_touch() */
    void
    update(const Particles &particles, const std::vector<Surface> &surfaces, const SharedSurfaces &with_others = {});
    /** The same, of all that are nearer than a distance [m], whatever there was before. */
    void search_around(const Particles &particles, const std::vector<Surface> &surfaces, double distance);
    /** Forget all lists: places have changed otherwise than by steps. */
    void forget() { stale = true; }

    const std::vector<std::int32_t> &particles() const { return listed; } ///< those that have a facet near, ascending
    /** Facets of the k-th of them. */
    const NearFacet *begin(const std::size_t k) const { return near.data() + from[k]; }
    const NearFacet *end(const std::size_t k) const { return near.data() + from[k + 1]; }
    /** Whether the k-th of them can touch any of its facets now. */
    bool within_reach(const std::size_t k) const { return smallest[k] <= path; }
    bool within_reach(const NearFacet &pair) const { return pair.gap <= path; }

    double       good_for() const { return margin; }       ///< lists are while nothing has moved further [m]
    std::int64_t searches() const { return search_count; } ///< how often lists were made
    std::int64_t tested() const { return test_count; }     ///< pairs whose distance this process found for them, so far

  private:
    struct FoundPair
    {
      std::int32_t particle;
      NearFacet    pair;
    };

    bool
    still_good(const Particles &particles, const std::vector<Surface> &surfaces, const SharedSurfaces &with_others);
    void   make_lists(const Particles            &particles,
                      const std::vector<Surface> &surfaces,
                      double                      nearer_than,
                      const SharedSurfaces       &with_others);
    void   tabulate(const std::vector<FoundPair> &found, std::size_t particles);
    double displacement(const Particles            &particles,
                        const std::vector<Surface> &surfaces,
                        const SharedSurfaces       &with_others) const;

    bool                         stale  = true;
    double                       margin = 0, path = 0, next_update = 0;
    std::vector<Eigen::Vector3d> particle_reference;
    std::vector<Eigen::Vector3d> vertex_reference; ///< of all surfaces, one after another
    std::vector<std::int32_t>    listed;
    std::vector<std::size_t>     from = {0};
    std::vector<NearFacet>       near;
    std::vector<double>          smallest; ///< gap of each particle of the list
    std::int64_t                 search_count = 0, test_count = 0;
  };
} // namespace dem
