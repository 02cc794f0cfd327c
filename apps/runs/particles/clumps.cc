#include "apps/runs/particles/clumps.h"

#include "base/errors.h"

#include <cmath>

namespace apps
{
  namespace
  {
    /** Its particles as they are, all together: their mass, its centre, and their inertia about it. */
    dem::RigidClump together(const dem::ObservedSpecimen &specimen, const std::vector<std::size_t> &particles)
    {
      dem::RigidClump clump;
      clump.particles = particles;
      for (const std::size_t i : particles)
        {
          const dem::ParticleState p = specimen.particle(i);
          clump.mass += p.mass;
          clump.centre += p.mass * p.position;
        }
      clump.centre /= clump.mass;
      for (const std::size_t i : particles)
        {
          const dem::ParticleState p   = specimen.particle(i);
          const Eigen::Vector3d    arm = p.position - clump.centre;
          clump.inertia += p.inertia * Eigen::Matrix3d::Identity() +
                           p.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
        }
      return clump;
    }

    /** The shape that its particles stand for, of their density. */
    dem::RigidClump shaped(const dem::ObservedSpecimen    &specimen,
                           const std::vector<std::size_t> &particles,
                           const dem::PackedBody          &body)
    {
      const dem::SpecimenParameters &p     = specimen.parameters();
      const dem::ParticleState       one   = specimen.particle(particles.at(0));
      const double                   solid = p.physics.dimension == 2 ? M_PI * one.radius * one.radius :
                                                                        4.0 / 3.0 * M_PI * one.radius * one.radius * one.radius;
      dem::RigidClump                clump;
      clump.particles = particles;
      clump.mass      = one.mass / solid * body.volume; // the thickness of discs is in both masses
      clump.centre    = body.centre;
      clump.inertia   = clump.mass * body.inertia;
      return clump;
    }

    constexpr std::size_t fewest_pebbles = 3;
  } // namespace

  dem::ConvexBody ClumpSection::shape(const int dimension) const { return {places_of(corners, dimension), dimension}; }

  void ClumpsSection::check(const base::EntryPath &root, const int dimension, GroupNames &names) const
  {
    const base::EntryPath all = root.at("Clumps");
    for (const ClumpSection &given : clumps)
      {
        const base::EntryPath section = all.at(given.group);
        if (dimension == 3 && given.inertia > 0)
          section.refuse("Inertia",
                         "in three dimensions it is that of the shape or of the particles, in proportion to the mass. "
                         "Leave it out.");
        if (given.inside && !given.has_shape())
          section.refuse("Pebbles", "there is no shape to lie inside of. Give its Corners.");
        if (given.inside && names.knows(given.group))
          section.refuse("Pebbles",
                         "there is a group of this name already, and those inside would be another one. Choose "
                         "another name for the sub-section, or Pebbles = group.");
        if (given.has_shape())
          try
            {
              given.shape(dimension);
            }
          catch (const base::InputError &refused)
            {
              section.refuse("Corners", refused.what());
            }
        if (given.inside)
          names.names.push_back(given.group);
      }
    for (const ClumpSection &given : clumps)
      names.require_section(all, given.group);
  }

  void ClumpsSection::find_pebbles(const dem::Packing &packing, const int dimension, ParticleGroups &found) const
  {
    for (const ClumpSection &given : clumps)
      {
        if (!given.inside)
          continue;
        const dem::ConvexBody shape   = given.shape(dimension);
        auto                 &pebbles = found[given.group];
        for (std::size_t i = 0; i < packing.size(); ++i)
          if (shape.holds(packing.centre[i]))
            pebbles.push_back(i);
        if (pebbles.size() < fewest_pebbles)
          throw base::InputError("Clumps/" + given.group + "/Corners: the centres of " +
                                 std::to_string(pebbles.size()) + " particles lie in the shape, it needs " +
                                 std::to_string(fewest_pebbles) +
                                 ". Check its place and size against the packing (metres).");
      }
  }

  std::function<bool(std::size_t, std::size_t)> ClumpsSection::one_body(const ParticleGroups &groups,
                                                                        const std::size_t     particles) const
  {
    std::vector<int> body(particles, -1);
    int              next = 0;
    for (const ClumpSection &given : clumps)
      {
        for (const std::size_t i : groups.at(given.group))
          body[i] = next;
        ++next;
      }
    return [body](const std::size_t first, const std::size_t second) {
      return body[first] >= 0 && body[first] == body[second];
    };
  }

  void ClumpsSection::make(dem::Specimen &specimen, const ParticleGroups &groups) const
  {
    for (const ClumpSection &given : clumps)
      {
        const auto     &pebbles = groups.at(given.group);
        dem::RigidClump clump =
          given.has_shape() ?
            shaped(specimen, pebbles, given.shape(specimen.parameters().physics.dimension).properties()) :
            together(specimen, pebbles);
        if (given.mass > 0)
          {
            clump.inertia *= given.mass / clump.mass;
            clump.mass = given.mass;
          }
        if (given.inertia > 0)
          clump.inertia(2, 2) = given.inertia;
        try
          {
            specimen.clumps().add(clump);
          }
        catch (const base::InputError &refused)
          {
            throw base::InputError("Clumps/" + given.group + ": " + refused.what());
          }
      }
  }
} // namespace apps
