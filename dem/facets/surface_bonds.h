#pragma once

#include "base/state.h"
#include "dem/facets/near_facets.h"
#include "dem/facets/pressure.h"
#include "dem/facets/surface.h"
#include "dem/model/break_log.h"
#include "dem/model/link_law.h"
#include "dem/model/links.h"
#include "dem/model/particles.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace dem
{
  struct GlueOutput;
  class LinkReader;

  /**
   * Particles that are glued to a surface (doc/theory/surface-coupling.md, 5).
   *
   * Each is linked to the point of the facet that was nearest to it, its anchor: a link of half the usual length, from the particle's
   * centre to the face, under a law of links as between particles. Anchors move and turn with their facets, and what the links do to
   * them goes to the corners: forces by the shape functions, couples by the smallest forces that are one. Same bits for any number of
   * threads.
   */
  class SurfaceBonds
  {
  public:
    /**
     * Glue whatever is near enough of those that the surface meets.
     * @param number of the surface among all @param rotations whether particles turn
     * @throws base::InputError where no particle is near, or one lies in the surface
     */
    SurfaceBonds(std::int32_t                   number,
                 const std::vector<Surface>    &surfaces,
                 const Particles               &particles,
                 const ParticleShape           &shape,
                 double                         within,
                 std::shared_ptr<const LinkLaw> law,
                 bool                           rotations);

    std::int32_t surface() const { return surface_number; }
    std::size_t  count() const { return particle.size(); } ///< made at the start
    bool         holds() const { return links.alive > 0; }
    std::int32_t particle_of(const std::size_t bond) const { return particle[bond]; } ///< in the order of Particles
    bool         is_alive(const std::size_t bond) const { return links.is_alive(bond); }
    std::int64_t torn() const { return torn_count; } ///< since the start
    /** What broke when forces were last found, elements that had broken before included; first ends in the order of Particles, no time. */
    const std::vector<Break> &breaks() const { return broken; }

    /** Forces where everything is now. @return the particles that were torn off, which carry nothing from now on */
    std::vector<std::int32_t> find_forces(const Particles &particles, const Surface &surface);
    /** Enter them: of particles in their records, of vertices in the surface. */
    void hand_out(base::Column &records, Surface &surface) const;
    /** What they have done to vertices. */
    const std::vector<VertexPart> &parts() const { return vertex_parts; }

    double stored() const;   ///< [J]
    double damage() const;   ///< dissipated since the start [J]
    double friction() const; ///< likewise
    double released() const; ///< set free by what was torn, likewise

    /** kappa_c of a living bond as its particle sees it, for the stable step [N/m]. */
    double stiffness_seen(std::size_t bond) const { return seen[bond]; }
    /** From the particle to the anchor, and the force on the particle, at t_n [m], [N]. */
    Eigen::Vector3d branch(std::size_t bond) const;
    Eigen::Vector3d force(std::size_t bond) const;
    Eigen::Vector3d couple_on_particle(std::size_t bond) const; ///< [N m]

    /** Add all bonds to those that an observer sees. */
    void show(GlueOutput &out, const Particles &particles, const Surface &surface) const;

    void visit_state(base::StateVisitor &visitor, const std::string &group, const Surface &surface);

  private:
    struct Anchor
    {
      std::int32_t          facet;
      std::array<double, 3> weight; ///< of its corners
    };

    void find_anchors(const std::vector<Surface> &surfaces, const Particles &particles, double within);
    void make_bodies(const Particles &particles);
    void make_bonds(const ParticleShape &shape, bool rotations);
    /** Bodies and anchors are where particles and facets are now. */
    void follow(const Particles &particles, const Surface &surface);
    void note_breaks(std::size_t bond, const LinkReader &reader);
    /** Check whether a bond is broken or gone; its particle is then added to those that are off. */
    void tear_off(std::size_t bond, std::vector<std::int32_t> &off);
    /** To the corners of the facets. */
    void share_out(const Surface &surface);

    Eigen::Vector3d couple_on_anchor(std::size_t bond) const;
    Eigen::Vector3d moment(std::size_t bond) const;
    template <typename Quantity>
    double sum_of_living(const Quantity &quantity) const;

    std::int32_t                   surface_number;
    std::shared_ptr<const LinkLaw> law;
    LinkPass                       pass;
    std::vector<std::int32_t>      particle;
    std::vector<Anchor>            anchor;
    Particles                      bodies; ///< the glued ones as they are in the specimen, and after them the anchors
    LinkSet                        links;
    std::vector<double>            seen;             ///< [N/m]
    std::vector<double>            pulling, turning; ///< stiffness that the anchor feels [N/m], [N m]
    std::vector<VertexPart>        vertex_parts;
    std::vector<Break>             broken;
    std::int64_t                   torn_count  = 0;
    double                         torn_damage = 0, let_go = 0; ///< [J]
  };
} // namespace dem
