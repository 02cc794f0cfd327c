#include "postprocess/vtk/fields.h"

#include "fem/points/all.h"

#include <algorithm>
#include <stdexcept>

namespace postprocess
{
  namespace
  {
    constexpr Field::Of points = Field::Of::points, cells = Field::Of::cells;

    constexpr const char *several = "several materials", *periodic = "periodic cells",
                         *glued = "particles glued to surfaces", *pieces = "snapshots in a piece per rank",
                         *classed = "several materials, or joints";

    FieldFile particle_fields()
    {
      return {
        "particles",
        "TEST_particles.pvd, cell_particles.pvd",
        "a point per particle, at its present place",
        {{"id", "", 1, points, "number of the particle in the packing, from 1 as in files of groups and in messages",
          ""},
         {"radius", "m", 1, points, "of the sphere or disc", ""},
         {"displacement", "m", 3, points, "since the specimen was made", ""},
         {"velocity", "m/s", 3, points, "", ""},
         {"angular_velocity", "rad/s", 3, points, "", ""},
         {"damage", "-", 1, points, "mean damage of the links that the particle was made with; broken ones count as 1",
          ""},
         {"broken_links", "", 1, points, "how many of these links are gone", ""},
         {"phase", "", 1, points, "number of the particle's material, from 0", ""},
         {"material", "", 1, points, "the same", several},
         {"stress", "Pa", 6, points, "over the particle's share of the volume, tension positive (Love-Weber)", ""}}};
    }

    FieldFile link_fields()
    {
      return {
        "links",
        "TEST_links.pvd, cell_links.pvd",
        "a line per link or contact between the present places of its particles, or from a particle to the periodic "
        "image that it "
        "is linked to, or to the place where it is or was glued to a surface; the points are the particles, then these "
        "images and places",
        {{"id", "", 1, points,
          "number of the particle in the packing, from 1; an image has that of its particle, a place on a surface -1",
          ""},
         {"radius", "m", 1, points, "of the particle", ""},
         {"displacement", "m", 3, points, "of the particle, or of the image", ""},
         {"normal_force", "N", 1, cells, "tension positive", ""},
         {"shear_force", "N", 1, cells, "magnitude", ""},
         {"normal_stress", "Pa", 1, cells, "force over the section of the link", ""},
         {"shear_stress", "Pa", 1, cells, "magnitude, over the section of the link", ""},
         {"normal_strain", "-", 1, cells, "elongation over length", ""},
         {"damage", "-", 1, cells, "0: whole; 1: without stiffness in tension, and of broken links and contacts", ""},
         {"kind", "", 1, cells, "0: cohesive, 1: contact, 2: broken", ""},
         {"broken", "", 1, cells, "1: the link was deleted", ""},
         {"material_pair", "", 1, cells, "pair of materials that the link joins (0-0: 0, 1-0: 1, 1-1: 2, 2-0: 3, ...)",
          several},
         {"class", "", 1, cells,
          "number of the link's class in `link_classes` of the summary, from 0 (of a mix 0: mortar, 1: interface, 2: "
          "aggregate); -1: to a surface",
          classed},
         {"surface", "", 1, cells, "number of the wall or coupling that the link leads to, from 0; -1: to a particle",
          glued},
         {"to_image", "", 1, cells, "1: the link leads to a periodic image of its second particle", periodic},
         {"line", "", 1, cells, "ascends over all pieces in the order that links have in one file", pieces}}};
    }

    FieldFile wall_fields()
    {
      return {"walls",
              "particles_walls.pvd",
              "the facets of walls at their present places; unbounded planes are left out",
              {{"force", "N", 3, points, "of the particles on the wall, shared out to its corners", ""},
               {"wall", "", 1, cells, "number of the wall in the scene, from 0", ""}}};
    }

    FieldFile break_fields()
    {
      return {"breaks",
              "particles_breaks.pvd",
              "what has broken so far, bonds or elements of them: in the plane a segment as long as it was, in space a "
              "point; where it "
              "lay when it broke",
              {{"break_time", "s", 1, cells, "when it broke", ""},
               {"mode", "", 1, cells, "0: tension, 1: shear, 2: damaged until it was broken", ""},
               {"element", "", 1, cells, "of a joint of several, from 0", ""},
               {"material_pair", "", 1, cells, "pair of materials that it joined, as of links", ""},
               {"surface", "", 1, cells,
                "that the particle was glued to, as walls are numbered; -1: to another particle", ""},
               {"normal", "-", 3, cells, "across it, unit", ""},
               {"area", "m^2", 1, cells, "of what broke", ""}}};
    }

    FieldFile emission_fields()
    {
      return {"emission",
              "emission.vtp, of uniaxial tests TEST_emission.vtp",
              "events of acoustic emission, at the mean place of their breaks, of scenes with `Emission/Reach`",
              {{"event_time", "s", 1, cells, "of its first break", ""},
               {"breaks", "", 1, cells, "bonds or elements of them that broke in it", ""},
               {"area", "m^2", 1, cells, "of what broke", ""},
               {"moment", "N m", 6, cells, "moment tensor, when it was largest", ""},
               {"scalar_moment", "N m", 1, cells, "its size", ""},
               {"magnitude", "-", 1, cells, "moment magnitude", ""},
               {"isotropic_share", "-", 1, cells, "1: explosion, 0: shear, -1: implosion", ""}}};
    }

    FieldFile solid_fields()
    {
      return {"solid",
              "solid.pvd, transfer.pvd (mesh)",
              "the finite elements; what integration points know is shown of elements as the largest of their points, "
              "and at nodes as "
              "average over the points around, weighted with their volume",
              {{"displacement", "m", 3, points, "", ""},
               {"reaction", "N", 3, points, "internal less external force", ""},
               {"stress", "Pa", 6, points, "average at the node, tension positive", ""},
               {"strain", "-", 6, points, "average at the node; tensor shears, half the engineering ones", ""}}};
    }

    Field field_of(const fem::PointQuantity &of, const char *material)
    {
      using Kind         = fem::PointQuantity::Kind;
      const bool  number = of.kind == Kind::number;
      std::string meaning(of.meaning);
      meaning += (meaning.empty() ? "" : ", ") + std::string(number ? "largest in the element" : "average at the node");
      if (of.kind == Kind::strain)
        meaning += "; tensor shears";
      return {of.name, of.unit, of.values(), number ? cells : points, meaning, material};
    }

    /** What a material shows of its history; a field that others have too is theirs together. */
    template <typename Law>
    void add_history(std::vector<Field> &fields)
    {
      for (const fem::PointQuantity &of : fem::quantities_of<Law>())
        {
          if (of.shown == fem::PointQuantity::Shown::nowhere)
            continue;
          const auto known =
            std::find_if(fields.begin(), fields.end(), [&](const Field &f) { return f.name == of.name; });
          if (known == fields.end())
            fields.push_back(field_of(of, Law::name));
          else
            known->only += std::string(", ") + Law::name;
        }
    }

    template <typename... Laws>
    void add_histories(std::vector<Field> &fields, const std::tuple<Laws...> * /*of these types*/)
    {
      (add_history<Laws>(fields), ...);
    }

    FieldFile solid_fields_with_histories()
    {
      FieldFile file = solid_fields();
      add_histories(file.fields, static_cast<const fem::Materials *>(nullptr));
      return file;
    }

    FieldFile transferred_particle_fields()
    {
      return {"transferred particles",
              "transfer.pvd (particles)",
              "a point per particle that is handed over, where it was when the specimen was made",
              {{"radius", "m", 1, points, "of the particle", ""},
               {"volume", "m^3", 1, points, "the particle's share of the specimen, voids included", ""},
               {"damage", "-", 1, points,
                "mean lost part of the strength of its links: a third of the trace of the tensor (half in two "
                "dimensions)",
                ""},
               {"stress", "Pa", 6, points, "of the particle", ""},
               {"damage_tensor", "-", 6, points, "of the particle", ""},
               {"mapped_stress", "Pa", 6, points, "the average that an element here would be given", ""},
               {"mapped_damage_tensor", "-", 6, points, "the average that an element here would be given", ""},
               {"mapped_raw_damage", "-", 1, points, "damage that the mapping law makes of it, before limits", ""},
               {"stress_difference", "Pa", 6, points, "mapped less own", ""},
               {"damage_tensor_difference", "-", 6, points, "mapped less own", ""}}};
    }

    FieldFile integration_point_fields()
    {
      return {"integration points",
              "transfer.pvd (integration points)",
              "a point per integration point that was given a history",
              {{"volume", "m^3", 1, points, "its share of the solid", ""},
               {"stress", "Pa", 6, points, "average of the particles around, as handed over", ""},
               {"damage_tensor", "-", 6, points, "average of the particles around", ""},
               {"damage", "-", 1, points, "scalar damage handed over", ""},
               {"raw_damage", "-", 1, points, "the same before limits", ""},
               {"damage_driving", "-", 1, points, "variable that drives the damage, as handed over", ""},
               {"hardening", "-", 1, points, "hardening variable handed over", ""},
               {"particles", "", 1, points, "how many particles the averages are of", ""},
               {"offset", "-", 1, points,
                "distance from the point to the centre of the averages' weights, in widths of the kernel: how "
                "one-sided they are",
                ""},
               {"returned_stress", "Pa", 1, points, "by which the stress was moved back to the yield surface", ""}}};
    }

    FieldFile node_fields()
    {
      return {"nodes",
              "nodes.pvd",
              "a point per node of a peridynamic body, at its present place",
              {{"damage", "-", 1, points, "part of the volume within its horizon to which bonds are gone", ""},
               {"volume", "m^3", 1, points, "of the node", ""},
               {"material", "", 1, points, "number in section Materials, from 0", several},
               {"displacement", "m", 3, points, "without rigid motion where nothing is held", ""}}};
    }

    const char *kind_of(const Field &field)
    {
      return field.components == 1 ? "number" : field.components == 3 ? "vector" : "tensor";
    }
  } // namespace

  const Field &FieldFile::field(const std::string &field_name) const
  {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field &f) { return f.name == field_name; });
    if (found == fields.end())
      throw std::logic_error("a file of " + name + " has no field \"" + field_name +
                             "\": declare it in postprocess/vtk/fields.cc");
    return *found;
  }

  const std::vector<FieldFile> &field_files()
  {
    static const std::vector<FieldFile> all = {particle_fields(),
                                               link_fields(),
                                               wall_fields(),
                                               break_fields(),
                                               emission_fields(),
                                               solid_fields_with_histories(),
                                               transferred_particle_fields(),
                                               integration_point_fields(),
                                               node_fields()};
    return all;
  }

  const FieldFile &field_file(const std::string &name)
  {
    for (const FieldFile &file : field_files())
      if (file.name == name)
        return file;
    throw std::logic_error("there are no files of \"" + name + "\" for ParaView");
  }

  std::string fields_as_markdown()
  {
    std::string text;
    for (const FieldFile &file : field_files())
      {
        std::string title = file.name;
        title.front()     = static_cast<char>(title.front() - 'a' + 'A');
        text += "### " + title + "\n\n`" + file.collections + "`: " + file.shows + ".\n\n";
        text += "| Field | Unit | Kind | Data of | Meaning |\n|---|---|---|---|---|\n";
        for (const Field &f : file.fields)
          {
            const std::string where =
              f.only.empty() ? "" : (f.meaning.empty() ? "" : "; ") + std::string("only ") + f.only;
            text += "| `" + f.name + "` | " + f.unit + " | " + kind_of(f) + " | " +
                    (f.of == points ? "points" : "cells") + " | " + f.meaning + where + " |\n";
          }
        text += "\n";
      }
    return text;
  }
} // namespace postprocess
