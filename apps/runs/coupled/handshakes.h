#pragma once

#include "apps/runs/continuum/model.h"
#include "apps/runs/particles/groups.h"
#include "base/entry_path.h"
#include "coupling/volume/parameters.h"

#include <array>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** Sub-section of "Handshakes": a region of particles inside the solid, and the layer around it where both are. */
  struct HandshakeSection
  {
    enum class Region
    {
      box,
      ball,
      elements
    };
    enum class Ties
    {
      coarse,
      strict,
      lumped
    };

    const ContinuumModel         *solid = nullptr; ///< around it: that of the same scene
    std::string                   name;
    Region                        region = Region::box;
    std::array<double, 3>         low{}, high{}, centre{}; ///< [m]
    double                        radius = 0, width = 0;   ///< [m]
    std::string                   elements;                ///< group of the mesh that particles take the place of
    coupling::VolumeMethod        method    = coupling::VolumeMethod::multipliers;
    bool                          absorbs   = true;
    Ties                          ties      = Ties::coarse;
    std::int64_t                  sharpness = 3;
    coupling::AbsorberProportions proportions;
    double                        energy_limit = 0.01, damage_limit = 0.01;
    double promote_at = 0; ///< exertion of a bond in elements at which they become particles; 0: none do
    double reach      = 0; ///< how far from the region they may [m]

    /** @throws base::InputError for elements that there are not */
    coupling::Overlap overlap() const;
    /** The same around another region. @param distance from it, negative inside [m] */
    HandshakeSection around(std::function<double(const Eigen::Vector3d &)> distance) const;
    bool             promotes() const { return promote_at > 0; }
    /** @param element_size of the solid in the overlap [m] @param wave_speed of compression there [m/s] */
    coupling::VolumeCouplingParameters parameters(double element_size, double wave_speed) const;
    /** Whether the particles have the place of elements there. */
    bool takes(const Eigen::Vector3d &place) const;

  private:
    mutable std::function<double(const Eigen::Vector3d &)> from_elements; ///< found when first needed
  };

  /** Section "Handshakes". */
  struct HandshakesSection
  {
    std::list<HandshakeSection> handshakes;

    /** @throws base::InputError for a region that is none, or a method that wants an overlap without one */
    void check(const base::EntryPath &root, int dimension) const;
    bool empty() const { return handshakes.empty(); }

    /** What of the solid counts at a place, in (0, 1]; empty: all, everywhere. */
    std::function<double(const Eigen::Vector3d &)> share_of_solid() const;
    /** Whether it is the particles' alone: no element lies wholly in such. */
    bool is_taken(const Eigen::Vector3d &place) const;
    /** Whether particles of the specimen may be there: in a region or its overlap. */
    bool may_hold(const Eigen::Vector3d &place) const;
    /** The same once elements have become particles as far as they may. */
    bool may_come_to_hold(const Eigen::Vector3d &place) const;
    /** Of all but this one, by name. */
    std::vector<std::pair<std::string, coupling::Overlap>> others_of(const HandshakeSection &one) const;
    bool promote() const; ///< whether elements may become particles at all
  };
} // namespace apps
