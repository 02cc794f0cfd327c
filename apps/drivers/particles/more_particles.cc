#include "apps/drivers/particles/more_particles.h"

#include "apps/scene/corner_list.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/nearest_name.h"
#include "apps/scene/number_list.h"
#include "apps/specimens/packing_file.h"
#include "apps/specimens/specimen_packing.h"
#include "dem/packing/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace apps
{
  void AddedParticles::declare(Section &s)
  {
    const auto is = [this](const Source wanted) { return [this, wanted] { return source == wanted; }; };
    s.choice("Source", source, {{"sphere", Source::sphere}, {"file", Source::file}, {"body", Source::body}},
             Need::optional)
      .means("sphere: one, in two dimensions a disc; file: all of another packing; body: a rigid convex polyhedron, in "
             "two dimensions a polygon, filled with pebbles");
    s.file("File", file).means("Packing, as Specimen/File").only_if(is(Source::file), "Source = file");
    declare_packing_unit(s, length_unit).only_if(is(Source::file), "Source = file");
    s.vector("Centre", centre, "m", Range(), Need::optional)
      .means("Of the sphere; of a file and of corners, what is added to the places there");
    s.number("Radius", radius, "m", Range::positive(), Need::required)
      .means("Of the sphere; of each pebble")
      .only_if([this] { return source != Source::file; }, "Source = sphere or body");
    declare_list(s, "Corners", corners, "m", Need::required)

      .means("Of the body [m], coordinates between commas, corners between semicolons; those of a polygon in their "
             "order. Its mass, centre and inertia are those of the shape, whatever its pebbles")
      .only_if(is(Source::body), "Source = body");
    s.choice("Filling", filling, {{"close", dem::Filling::close}, {"cubic", dem::Filling::cubic}}, Need::optional)
      .means("How touching pebbles lie in the body. close: as densely as can be; cubic: in a grid along the axes")
      .only_if(is(Source::body), "Source = body");
    s.flag("Bonded", bonded)
      .means("Linked to particles within the interaction ratio, as those of the specimen are; off: only touched");
    s.text("Material", material, Need::optional)
      .means("Name of a section in Materials; empty: as Regions say, or the file");
  }

  void
  AddedParticles::check(const base::EntryPath &section, const int dimension, const MaterialSection &materials) const
  {
    if (source == Source::file && !std::filesystem::is_regular_file(file))
      section.refuse("File", "there is no such file.");
    if (dimension == 2 && centre[2] != 0)
      section.refuse("Centre", "in two dimensions it lies in the plane: its z must be 0.");
    if (source == Source::body)
      try
        {
          particles(dimension);
        }
      catch (const base::InputError &refused)
        {
          section.refuse("Corners", refused.what());
        }
    const auto known = materials.names();
    if (!material.empty() && std::find(known.begin(), known.end(), material) == known.end())
      section.refuse("Material", "is not in section Materials. " + did_you_mean(material, known));
  }

  dem::Packing AddedParticles::particles(const int dimension) const
  {
    const Eigen::Vector3d place(centre[0], centre[1], centre[2]);
    if (source == Source::sphere)
      return {{place}, {radius}, {}};
    if (source == Source::body)
      {
        auto at = corners_in_text(corners, dimension);
        for (Eigen::Vector3d &corner : at)
          corner += place;
        return dem::filled_with_pebbles(dem::ConvexBody(at, dimension), radius, filling);
      }
    dem::Packing packing = packing_in_file(file, length_unit);
    packing.periodic_cell.reset(); // one body of it, as it is
    for (Eigen::Vector3d &each : packing.centre)
      each += place;
    for (dem::PackedBody &body : packing.bodies)
      body.centre += place;
    return packing;
  }

  void MoreParticlesSection::declare(Section &root)
  {
    root
      .section("More particles",
               "One sub-section per sphere, packing or rigid body of pebbles beside the specimen; each "
               "is a group of its name as well")
      .named_sections("PARTICLES", [this](Section &opened) {
        AddedParticles &one = added.emplace_back();
        one.name            = opened.name();
        one.declare(opened);
      });
  }

  void MoreParticlesSection::check(const base::EntryPath &root,
                                   const int              dimension,
                                   const MaterialSection &materials,
                                   GroupNames            &names) const
  {
    for (const AddedParticles &one : added)
      {
        const base::EntryPath section = root.at("More particles").at(one.name);
        if (names.knows(one.name))
          section.refuse("all particles are the group \"all\". Choose another name.");
        one.check(section, dimension, materials);
        names.names.push_back(one.name);
      }
  }

  namespace
  {
    void append(dem::Packing &whole, const dem::Packing &part)
    {
      if (!whole.clump.empty() || !part.clump.empty())
        {
          whole.clump.resize(whole.size(), -1);
          for (std::size_t i = 0; i < part.size(); ++i)
            whole.clump.push_back(part.clump.empty() || part.clump[i] < 0 ?
                                    -1 :
                                    part.clump[i] + static_cast<std::int32_t>(whole.bodies.size()));
          whole.bodies.insert(whole.bodies.end(), part.bodies.begin(), part.bodies.end());
        }
      whole.centre.insert(whole.centre.end(), part.centre.begin(), part.centre.end());
      whole.radius.insert(whole.radius.end(), part.radius.begin(), part.radius.end());
      whole.material.insert(whole.material.end(), part.material.begin(), part.material.end());
      if (whole.material_names.empty())
        whole.material_names = part.material_names;
    }

    dem::Packing numbered(const AddedParticles &one, const MaterialSection &materials, const int dimension)
    {
      dem::Packing part = one.particles(dimension);
      materials.number(part, dimension,
                       one.source == AddedParticles::Source::file ? one.file : "More particles/" + one.name);
      if (one.material.empty())
        return part;
      const auto known = materials.names();
      part.material.assign(
        part.size(), static_cast<std::int32_t>(std::find(known.begin(), known.end(), one.material) - known.begin()));
      return part;
    }
  } // namespace

  std::vector<const AddedParticles *> MoreParticlesSection::in_order() const
  {
    std::vector<const AddedParticles *> order;
    for (const AddedParticles &one : added)
      order.push_back(&one);
    std::stable_partition(order.begin(), order.end(), [](const AddedParticles *one) { return one->bonded; });
    return order;
  }

  namespace
  {
    dem::Packing kept_of(const dem::Packing &all, const std::function<bool(const Eigen::Vector3d &)> &keeps)
    {
      const dem::Packing kept = particles_where(all, [&](const std::size_t i) { return keeps(all.centre[i]); });
      if (kept.size() > 0 || all.size() == 0)
        return kept;
      Eigen::Vector3d low = all.centre.front(), high = low;
      for (const Eigen::Vector3d &centre : all.centre)
        {
          low  = low.cwiseMin(centre);
          high = high.cwiseMax(centre);
        }
      throw base::InputError(fmt::format(
        "Handshakes: no particle of the specimen lies in a region or its overlap: they are between ({:g}, {:g}, "
        "{:g}) and ({:g}, {:g}, {:g}) m. Move the regions to where particles are.",
        low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
    }
  } // namespace

  dem::Packing MoreParticlesSection::compose(const SpecimenSection                              &specimen,
                                             const MaterialSection                              &materials,
                                             const int                                           dimension,
                                             const OneBody                                      &one_body,
                                             const std::function<bool(const Eigen::Vector3d &)> &keeps,
                                             std::optional<dem::Packing> *const                  cell) const
  {
    dem::Packing whole;
    if (specimen.source != SpecimenSection::Source::none)
      {
        whole = specimen_particles(specimen, dimension, cell);
        if (keeps)
          whole = kept_of(whole, keeps);
        materials.number(whole, dimension, origin_of(specimen));
      }
    for (const AddedParticles *one : in_order())
      append(whole, numbered(*one, materials, dimension));
    const std::string origin = added.empty() ? origin_of(specimen) : "Specimen and More particles";
    materials.require_all(whole, origin);
    dem::check_packing(whole, origin);
    dem::check_overlaps(whole, origin, dimension, one_body(whole));
    return whole;
  }

  std::size_t MoreParticlesSection::loose(const int dimension) const
  {
    std::size_t count = 0;
    for (const AddedParticles &one : added)
      count += one.bonded ? 0 : one.particles(dimension).size();
    return count;
  }

  ParticleGroups MoreParticlesSection::groups_in(const std::size_t particles, const int dimension) const
  {
    ParticleGroups groups;
    std::size_t    end   = particles;
    const auto     order = in_order();
    for (auto one = order.rbegin(); one != order.rend(); ++one)
      {
        auto &members = groups[(*one)->name];
        members.resize((*one)->particles(dimension).size());
        end -= members.size();
        std::iota(members.begin(), members.end(), end);
      }
    return groups;
  }
} // namespace apps
