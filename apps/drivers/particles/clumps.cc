#include "apps/drivers/particles/clumps.h"

#include "base/errors.h"

namespace apps
{
  namespace
  {
    /** Its particles as they are, all together: their mass, its centre, and their inertia about it. */
    dem::RigidClump together(const dem::Specimen &specimen, const std::vector<std::size_t> &particles)
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
  } // namespace

  void ClumpsSection::declare(Section &root)
  {
    root
      .section("Clumps",
               "One sub-section per group whose particles move as one rigid body, named after the group: they "
               "keep their distances, and neither bonds nor contacts are between them")
      .named_sections("GROUP", [this](Section &opened) {
        ClumpSection &added = clumps.emplace_back();
        added.group         = opened.name();
        opened.number("Mass", added.mass, "kg", Range::at_least(0), Need::optional)
          .means("Of the body; 0: that of its particles together, overlaps counted twice");
        opened.number("Inertia", added.inertia, "kg m^2", Range::at_least(0), Need::optional)
          .means("About its centre, in two dimensions; 0: that of its particles together, in proportion to the mass");
      });
  }

  void ClumpsSection::validate(const Section &root, const int dimension, const GroupNames &names) const
  {
    const Section &all = *root.find_section("Clumps");
    names.require_sections(all);
    for (const ClumpSection &given : clumps)
      if (dimension == 3 && given.inertia > 0)
        all.find_section(given.group)
          ->refuse("Inertia",
                   "in three dimensions it is that of the particles, in proportion to the mass. Leave it out.");
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
        dem::RigidClump clump = together(specimen, groups.at(given.group));
        if (given.mass > 0)
          {
            clump.inertia *= given.mass / clump.mass;
            clump.mass = given.mass;
          }
        if (given.inertia > 0)
          clump.inertia(2, 2) = given.inertia;
        try
          {
            specimen.add_clump(clump);
          }
        catch (const base::InputError &refused)
          {
            throw base::InputError("Clumps/" + given.group + ": " + refused.what());
          }
      }
  }
} // namespace apps
