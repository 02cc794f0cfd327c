#include "apps/scene/particles/more_particles.h"

#include "apps/scene/entries/material.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/number_list.h"
#include "apps/scene/particles/groups.h"
#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &s, AddedParticles &added_particles)
  {
    using Source  = AddedParticles::Source;
    const auto is = [&added_particles](const Source wanted) {
      return [&added_particles, wanted] { return added_particles.source == wanted; };
    };
    s.choice("Source", added_particles.source,
             {{"sphere", Source::sphere}, {"file", Source::file}, {"body", Source::body}}, Need::optional)
      .means("sphere: one, in two dimensions a disc; file: all of another packing; body: a rigid convex polyhedron, in "
             "two dimensions a polygon, filled with pebbles");
    s.file("File", added_particles.file).means("Packing, as Specimen/File").only_if(is(Source::file), "Source = file");
    declare_packing_unit(s, added_particles.length_unit).only_if(is(Source::file), "Source = file");
    s.vector("Centre", added_particles.centre, "m", Range(), Need::optional)
      .means("Of the sphere; of a file and of corners, what is added to the places there");
    s.number("Radius", added_particles.radius, "m", Range::positive(), Need::required)
      .means("Of the sphere; of each pebble")
      .only_if([&added_particles] { return added_particles.source != Source::file; }, "Source = sphere or body");
    declare_list(
      s, "Corners", [&added_particles](const std::string &text) { added_particles.corners = corners_in_text(text); },
      "m", Need::required)
      .means("Of the body [m], coordinates between commas, corners between semicolons; those of a polygon in their "
             "order. Its mass, centre and inertia are those of the shape, whatever its pebbles")
      .only_if(is(Source::body), "Source = body");
    s.choice("Filling", added_particles.filling, {{"close", dem::Filling::close}, {"cubic", dem::Filling::cubic}},
             Need::optional)
      .means("How touching pebbles lie in the body. close: as densely as can be; cubic: in a grid along the axes")
      .only_if(is(Source::body), "Source = body");
    s.flag("Bonded", added_particles.bonded)
      .means("Linked to particles within the interaction ratio, as those of the specimen are; off: only touched");
    s.text("Material", added_particles.material, Need::optional)
      .means("Name of a section in Materials; empty: as Regions say, or the file");
  }

  void declare(Section &root, MoreParticlesSection &more_particles)
  {
    root
      .section("More particles",
               "One sub-section per sphere, packing or rigid body of pebbles beside the specimen; each "
               "is a group of its name as well")
      .named_list("PARTICLES", more_particles.added, &AddedParticles::name);
  }
} // namespace apps
