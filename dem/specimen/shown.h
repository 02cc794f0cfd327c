#pragma once

#include "dem/model/held_lines.h"
#include "dem/specimen/results.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

/** What observers are shown of a specimen, read of all of it or of the part that one of several ranks has: for the sources of this folder. */
namespace dem
{
  struct Particles;
  struct SpecimenCore;

  /** Particles in a row that are shown, in the packing's order where they are all, otherwise as they follow each other. */
  struct ShownParticles
  {
    std::size_t first = 0, last = 0; ///< the first, and behind the last
    bool        as_packed = false;

    std::size_t size() const { return last - first; }
    bool        has(const std::size_t particle) const { return particle >= first && particle < last; }
  };

  ShownParticles all_of(const Particles &particles);

  /** Of one, by its place in the particles' order, since the start [m]. */
  Eigen::Vector3d displacement_of(const Particles &particles, std::size_t i);

  /** Where they are, and how they move. @pre these are up to date */
  ParticleKinematics kinematics_of(const SpecimenCore &core, const ShownParticles &shown);

  /** What bonds and contacts do to particles, in these' own order. */
  struct LinkEffects
  {
    std::vector<Eigen::Matrix3d> moments; ///< each_stress_moment() [N m]
    std::vector<double>          damage;  ///< lost parts of bonds that are there, added up [-]
  };

  /** @param in_parts read the links that this rank updates, which are all of its own particles */
  LinkEffects effects_of_links(const SpecimenCore &core, const ShownParticles &shown, bool in_parts);
  /** One of them. */
  std::vector<Eigen::Matrix3d> moments_of_links(const SpecimenCore &core, const ShownParticles &shown, bool in_parts);
  std::vector<double>          damage_of_links(const SpecimenCore &core, const ShownParticles &shown, bool in_parts);
  /** What surfaces and glue do, to be added to the first. */
  void
  add_moments_of_surfaces(const SpecimenCore &core, const ShownParticles &shown, std::vector<Eigen::Matrix3d> &moments);

  /** All of them. @pre as of kinematics_of() @param effects of links */
  ParticleOutput particles_of(const SpecimenCore &core, const ShownParticles &shown, LinkEffects effects);

  /** Of a particle, by its place in the particles' order: its share of the specimen's volume [m^3], and the stress of its moments [Pa]. */
  double          volume_of(const SpecimenCore &core, std::size_t i);
  Eigen::Matrix3d stress_of(const SpecimenCore &core, std::size_t i, const Eigen::Matrix3d &moments);
  /** Mean damage of the links that it was made with. @param damage of those that are there, added up */
  double mean_damage_of(const Particles &particles, std::size_t i, double damage);

  /** No links, and a column for each quantity that the law of the bonds shows. */
  LinkOutput without_links(const SpecimenCore &core);
  /** Some lines of a set; what has broken; glue to surfaces: as links_of() shows them. */
  LinkOutput links_among(const SpecimenCore &core, const LinkSet &links, const LinkRange &lines);
  LinkOutput broken_links(const SpecimenCore &core);
  GlueOutput glue_of(const SpecimenCore &core);

  /** Links, contacts, and what has broken or is glued, with the lines of links: see RankOutput. */
  struct ShownLinks
  {
    LinkOutput                links;
    std::vector<std::int64_t> line;
  };

  /** Those that begin at particles that are shown; of what broke or is glued all. @param in_parts read the links that this rank updates */
  ShownLinks links_of(const SpecimenCore &core, const ShownParticles &shown, bool in_parts);
} // namespace dem
