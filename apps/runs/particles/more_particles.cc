#include "apps/runs/particles/more_particles.h"

#include "apps/specimens/packing_file.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/text/nearest_name.h"
#include "dem/packing/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace apps
{
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
        auto at = places_of(corners, dimension);
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
      if (!whole.material.empty() || !part.material.empty()) // none of its own: of the first, with a mix the mortar
        {
          whole.material.resize(whole.size(), 0);
          whole.material.insert(whole.material.end(), part.material.begin(), part.material.end());
          whole.material.resize(whole.size() + part.size(), 0);
        }
      whole.centre.insert(whole.centre.end(), part.centre.begin(), part.centre.end());
      whole.radius.insert(whole.radius.end(), part.radius.begin(), part.radius.end());
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

  dem::Packing MoreParticlesSection::compose(const MixedSpecimen                                &specimen,
                                             const OneBody                                      &one_body,
                                             const std::function<bool(const Eigen::Vector3d &)> &keeps,
                                             std::optional<dem::Packing> *const                  cell) const
  {
    dem::Packing whole;
    if (specimen.source.source != SpecimenSection::Source::none)
      {
        whole = specimen_particles(specimen.source, specimen.dimension, cell);
        if (keeps)
          whole = kept_of(whole, keeps);
        specimen.number_part(whole, origin_of(specimen.source));
      }
    for (const AddedParticles *one : in_order())
      append(whole, numbered(*one, specimen.material, specimen.dimension));
    const std::string origin = added.empty() ? origin_of(specimen.source) : "Specimen and More particles";
    specimen.require_all(whole, origin);
    dem::check_packing(whole, origin);
    dem::check_overlaps(whole, origin, specimen.dimension, one_body(whole));
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
