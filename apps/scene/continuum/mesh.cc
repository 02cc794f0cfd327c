#include "apps/scene/continuum/mesh.h"

#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/length_unit_entry.h"
#include "apps/scene/section.h"
#include "base/errors.h"

namespace apps
{
  namespace
  {
    void declare_divisions(Section &box, std::array<std::int64_t, 3> &divisions, const int &dimension)
    {
      for (std::size_t i = 0; i < 3; ++i)
        {
          Entry &along =
            box.integer(std::string("Divisions ") + "xyz"[i], divisions[i], "", Range::between(1, 1e6), Need::optional);
          along.means("Elements along this edge");
          if (i == 2)
            along.only_if([&dimension] { return dimension == 3; }, "Model/Dimension = 3");
        }
    }
  } // namespace

  namespace
  {
    void declare_bodies(Section &mesh, MeshSection &model, const int &dimension)
    {
      using Source       = MeshSection::Source;
      const auto  bodies = [&model] { return model.source == Source::bodies; };
      const char *when   = "Mesh/Source = bodies";
      Section    &some =
        mesh.section("Boxes", "One sub-section per box: bodies that share no node, even where they touch. "
                              "Boundaries are those of a box with the body's name before: NAME left, "
                              "NAME front, or NAME x min, NAME z max");
      some.only_if(bodies, when);
      some.named_sections(
        "BODY", [&model, &dimension](Section &opened) { declare(opened, model.boxes.emplace_back(), dimension); });
      Section &others = mesh.section("Balls", "One sub-section per ball; its boundary has its name");
      others.only_if(bodies, when);
      others.named_sections("BODY", [&model](Section &opened) { declare(opened, model.balls.emplace_back()); });
    }

    void declare_beam(Section &mesh, MeshSection &model, const int &dimension)
    {
      using Source = MeshSection::Source;
      Section &s   = mesh.section("Notched beam", "Along x from the origin, notched from below at mid-span; boundaries "
                                                    "left, right, bottom, top, back, front, notch");
      s.only_if([&model] { return model.source == Source::notched_beam; }, "Mesh/Source = notched beam");
      const Condition solid{[&dimension] { return dimension == 3; }, "Model/Dimension = 3"};
      const auto      length = [&](const char *name, double &member, const char *meaning) -> Entry      &{
        return s.number(name, member, "m", Range::positive(), Need::required).means(meaning);
      };
      length("Length", model.beam.length, "Along x");
      length("Height", model.beam.height, "Along y");
      length("Width", model.beam.width, "Along z").only_if(solid);
      length("Span", model.beam.span, "Between the supports, at whose places there are nodes");
      length("Notch depth", model.beam.notch_depth, "From below");
      length("Notch width", model.beam.notch_width, "There are nodes at both edges of its mouth");
      length("Band", model.beam.band, "Width of the band of fine elements around the notch");
      length("Fine size", model.beam.fine_size, "Largest edge of the elements in the band, and of all upwards");
      length("Coarse size", model.beam.coarse_size, "Largest edge along x beside the band");
      s.integer("Width divisions", model.beam_width_divisions, "", Range::between(1, 1e4), Need::optional)
        .means("Elements across")
        .only_if(solid);
    }

    void declare_plate(Section &mesh, MeshSection &model, const int &dimension)
    {
      using Source = MeshSection::Source;
      Section &s =
        mesh.section("Plate with hole", "A quarter, around the origin; boundaries hole, left (x = 0), bottom "
                                        "(y = 0), right, top, back, front");
      s.only_if([&model] { return model.source == Source::plate_with_hole; }, "Mesh/Source = plate with hole");
      const Condition solid{[&dimension] { return dimension == 3; }, "Model/Dimension = 3"};
      s.number("Radius", model.plate.radius, "m", Range::positive(), Need::required).means("Of the hole");
      s.number("Half width", model.plate.half_width, "m", Range::positive(), Need::required)
        .means("Of the whole plate");
      s.number("Half height", model.plate.half_height, "m", Range::positive(), Need::required)
        .means("Of the whole plate");
      s.number("Depth", model.plate.depth, "m", Range::positive(), Need::required).means("Along z").only_if(solid);
      s.integer("Radial divisions", model.radial_divisions, "", Range::between(1, 1e4), Need::optional)
        .means("Elements from the hole to the edge");
      s.integer("Angular divisions", model.angular_divisions, "", Range::between(2, 1e4), Need::optional)
        .means("Elements around the hole, an even number");
      s.integer("Depth divisions", model.depth_divisions, "", Range::between(1, 1e4), Need::optional)
        .means("Elements along z")
        .only_if(solid);
    }
  } // namespace

  void declare(Section &s, BoxSection &box, const int &dimension)
  {
    box.name = s.name();
    s.vector("Corner", box.corner, "m", Range(), Need::optional).means("Of least coordinates");
    s.vector("Size", box.size, "m", Range::at_least(0), Need::required)
      .means("Edges; the third is not used in two dimensions");
    declare_divisions(s, box.divisions, dimension);
    s.text("Material", box.material, Need::optional).means("Name of its section in Materials");
  }

  void declare(Section &s, BallSection &ball)
  {
    ball.name = s.name();
    s.vector("Centre", ball.centre, "m", Range(), Need::optional).means("Of the ball, in two dimensions of the disc");
    s.number("Radius", ball.radius, "m", Range::positive(), Need::required)
      .means("Of the ball; nodes lie a little outside, so that with plane faces the volume is the ball's");
    s.integer("Divisions", ball.divisions, "", Range::between(2, 512), Need::optional)
      .means("Elements around a quarter of the circumference, where they are not finer; an even number");
    s.vector("Towards", ball.towards, "-", Range(), Need::optional)
      .means("Direction from the centre in which elements are finest; 0, 0, 0: nowhere");
    s.number("Fineness", ball.fineness, "-", Range::between(1, 1000), Need::optional)
      .means("How much smaller elements are there than elsewhere");
    s.text("Material", ball.material, Need::optional).means("Name of its section in Materials");
  }

  void declare(Section &root, MeshSection &mesh, const int &dimension)
  {
    using Source         = MeshSection::Source;
    const auto      from = [&mesh](const Source wanted) { return [&mesh, wanted] { return mesh.source == wanted; }; };
    const Condition built{[&mesh] { return mesh.source != Source::file; }, "Mesh/Source is not file"};
    Section        &s = root.section("Mesh", "The elements: where they come from");
    s.choice("Source", mesh.source,
             {{"file", Source::file},
              {"box", Source::box},
              {"bodies", Source::bodies},
              {"notched beam", Source::notched_beam},
              {"plate with hole", Source::plate_with_hole},
              {"cylinder", Source::cylinder}},
             Need::required)
      .means("file: a Gmsh mesh, whose named physical groups are the names of boundaries and materials; otherwise a "
             "shape, of the one material solid; bodies: boxes and balls, each by itself");
    s.file("File", mesh.file)
      .means("Gmsh 2.2 or 4.1, text; from the scene's folder")
      .only_if(from(Source::file), "Mesh/Source = file");
    s.flag("Several bodies", mesh.several_bodies)
      .means("The mesh may fall into parts that share no node; off: that is refused, as nodes not merged by mistake")
      .only_if(from(Source::file), "Mesh/Source = file");
    s.choice("Doubled nodes", mesh.notch, {{"refuse", false}, {"notch", true}}, Need::optional)
      .means("Of a file: several nodes at one place. refuse: as nodes not merged by mistake; notch: both faces of a "
             "notch or "
             "crack without width, which do not hold each other and may pass through each other where it closes")
      .only_if(from(Source::file), "Mesh/Source = file");
    declare_mesh_unit(s, mesh.length_unit).only_if(from(Source::file), "Mesh/Source = file");
    s.choice("Elements", mesh.family,
             {{"blocks", fem::ElementFamily::hypercube}, {"simplices", fem::ElementFamily::simplex}}, Need::optional)
      .means("blocks: quadrilaterals or hexahedra; simplices: 8 triangles in place of each quadrilateral, 24 "
             "tetrahedra of each hexahedron")
      .only_if(built);
    s.integer("Refinements", mesh.refinements, "", Range::between(0, 12), Need::optional)
      .means("Each halves every edge")
      .only_if(built);

    Section &box = s.section("Box", "From the origin; boundaries left, right, or x min, x max; bottom, top, or y min, "
                                    "y max; back, front, or z min, z max");
    box.only_if(from(Source::box), "Mesh/Source = box");
    box.vector("Size", mesh.box_size, "m", Range::at_least(0), Need::required)
      .means("Edges; the third is not used in two dimensions");
    declare_divisions(box, mesh.box_divisions, dimension);
    box.vector("Growth", mesh.box_growth, "-", Range::between(0.1, 10), Need::optional)
      .means(
        "Along each edge, the size of an element over that of its neighbour towards the origin: fine where it matters");
    declare_bodies(s, mesh, dimension);
    declare_beam(s, mesh, dimension);
    declare_plate(s, mesh, dimension);

    Section &bar = s.section("Cylinder", "Along x from the origin; boundaries left, right, side");
    bar.only_if(from(Source::cylinder), "Mesh/Source = cylinder");
    bar.number("Length", mesh.cylinder.length, "m", Range::positive(), Need::required).means("Along x");
    bar.number("Radius", mesh.cylinder.radius, "m", Range::positive(), Need::required).means("Of the section");
    bar.integer("Divisions", mesh.axial_divisions, "", Range::between(1, 1e6), Need::optional)
      .means("Elements along the axis; across there are five blocks");

    declare_geometry(s, mesh.mix.mix, "elements whose middle lies in an aggregate")
      .text("Group", mesh.mix.group, Need::optional)
      .means("Of the mesh, that is concrete, and becomes the two; empty: all of it");
  }
} // namespace apps
