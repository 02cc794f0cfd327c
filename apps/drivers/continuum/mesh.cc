#include "apps/drivers/continuum/mesh.h"

#include "apps/scene/length_unit_entry.h"
#include "base/errors.h"
#include "fem/mesh/extent.h"
#include "fem/mesh/gmsh.h"
#include "fem/mesh/shapes.h"

#include <fmt/format.h>

#include <filesystem>

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

    void require_edges(const base::EntryPath &box, const std::array<double, 3> &size, const int dimension)
    {
      for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
        if (!(size[i] > 0))
          box.refuse("Size", std::string("its edge along ") + "xyz"[i] + " must be positive.");
    }

    unsigned int whole(const std::int64_t number) { return static_cast<unsigned int>(number); }
  } // namespace

  void BoxSection::declare(Section &s, const int &dimension)
  {
    name = s.name();
    s.vector("Corner", corner, "m", Range(), Need::optional).means("Of least coordinates");
    s.vector("Size", size, "m", Range::at_least(0), Need::required)
      .means("Edges; the third is not used in two dimensions");
    declare_divisions(s, divisions, dimension);
    s.text("Material", material, Need::optional).means("Name of its section in Materials");
  }

  fem::NamedBox BoxSection::box() const
  {
    fem::NamedBox made;
    made.name     = name;
    made.material = material;
    made.corner   = corner;
    made.size     = size;
    for (std::size_t i = 0; i < 3; ++i)
      made.divisions[i] = whole(divisions[i]);
    return made;
  }

  void BallSection::declare(Section &s)
  {
    name = s.name();
    s.vector("Centre", centre, "m", Range(), Need::optional).means("Of the ball, in two dimensions of the disc");
    s.number("Radius", radius, "m", Range::positive(), Need::required)
      .means("Of the ball; nodes lie a little outside, so that with plane faces the volume is the ball's");
    s.integer("Divisions", divisions, "", Range::between(2, 512), Need::optional)
      .means("Elements around a quarter of the circumference, where they are not finer; an even number");
    s.vector("Towards", towards, "-", Range(), Need::optional)
      .means("Direction from the centre in which elements are finest; 0, 0, 0: nowhere");
    s.number("Fineness", fineness, "-", Range::between(1, 1000), Need::optional)
      .means("How much smaller elements are there than elsewhere");
    s.text("Material", material, Need::optional).means("Name of its section in Materials");
  }

  fem::NamedBall BallSection::ball() const
  {
    fem::NamedBall made;
    made.name      = name;
    made.material  = material;
    made.centre    = centre;
    made.radius    = radius;
    made.divisions = whole(divisions);
    made.towards   = towards;
    made.fineness  = fineness;
    return made;
  }

  void MeshSection::declare(Section &root, const int &dimension)
  {
    const auto from  = [this](const Source wanted) { return [this, wanted] { return source == wanted; }; };
    const auto built = [this] { return source != Source::file; };
    Section   &s     = root.section("Mesh", "The elements: where they come from");
    s.choice("Source", source,
             {{"file", Source::file},
              {"box", Source::box},
              {"bodies", Source::bodies},
              {"notched beam", Source::notched_beam},
              {"plate with hole", Source::plate_with_hole},
              {"cylinder", Source::cylinder}},
             Need::required)
      .means("file: a Gmsh mesh, whose named physical groups are the names of boundaries and materials; otherwise a "
             "shape, of the one material solid; bodies: boxes and balls, each by itself");
    s.file("File", file)
      .means("Gmsh 2.2 or 4.1, text; from the scene's folder")
      .only_if(from(Source::file), "Mesh/Source = file");
    s.flag("Several bodies", several_bodies)
      .means("The mesh may fall into parts that share no node; off: that is refused, as nodes not merged by mistake")
      .only_if(from(Source::file), "Mesh/Source = file");
    s.choice("Doubled nodes", notch, {{"refuse", false}, {"notch", true}}, Need::optional)
      .means("Of a file: several nodes at one place. refuse: as nodes not merged by mistake; notch: both faces of a "
             "notch or "
             "crack without width, which do not hold each other and may pass through each other where it closes")
      .only_if(from(Source::file), "Mesh/Source = file");
    declare_mesh_unit(s, length_unit).only_if(from(Source::file), "Mesh/Source = file");
    s.choice("Elements", family,
             {{"blocks", fem::ElementFamily::hypercube}, {"simplices", fem::ElementFamily::simplex}}, Need::optional)
      .means("blocks: quadrilaterals or hexahedra; simplices: 8 triangles in place of each quadrilateral, 24 "
             "tetrahedra of each hexahedron")
      .only_if(built, "Mesh/Source is not file");
    s.integer("Refinements", refinements, "", Range::between(0, 12), Need::optional)
      .means("Each halves every edge")
      .only_if(built, "Mesh/Source is not file");

    Section &box = s.section("Box", "From the origin; boundaries left, right, or x min, x max; bottom, top, or y min, "
                                    "y max; back, front, or z min, z max");
    box.only_if(from(Source::box), "Mesh/Source = box");
    box.vector("Size", box_size, "m", Range::at_least(0), Need::required)
      .means("Edges; the third is not used in two dimensions");
    declare_divisions(box, box_divisions, dimension);
    box.vector("Growth", box_growth, "-", Range::between(0.1, 10), Need::optional)
      .means(
        "Along each edge, the size of an element over that of its neighbour towards the origin: fine where it matters");
    declare_bodies(s, dimension);
    declare_beam(s, dimension);
    declare_plate(s, dimension);

    Section &bar = s.section("Cylinder", "Along x from the origin; boundaries left, right, side");
    bar.only_if(from(Source::cylinder), "Mesh/Source = cylinder");
    bar.number("Length", cylinder.length, "m", Range::positive(), Need::required).means("Along x");
    bar.number("Radius", cylinder.radius, "m", Range::positive(), Need::required).means("Of the section");
    bar.integer("Divisions", axial_divisions, "", Range::between(1, 1e6), Need::optional)
      .means("Elements along the axis; across there are five blocks");
  }

  void MeshSection::declare_bodies(Section &mesh, const int &dimension)
  {
    const auto  bodies = [this] { return source == Source::bodies; };
    const char *when   = "Mesh/Source = bodies";
    Section &some = mesh.section("Boxes", "One sub-section per box: bodies that share no node, even where they touch. "
                                          "Boundaries are those of a box with the body's name before: NAME left, "
                                          "NAME front, or NAME x min, NAME z max");
    some.only_if(bodies, when);
    some.named_sections("BODY",
                        [this, &dimension](Section &opened) { boxes.emplace_back().declare(opened, dimension); });
    Section &others = mesh.section("Balls", "One sub-section per ball; its boundary has its name");
    others.only_if(bodies, when);
    others.named_sections("BODY", [this](Section &opened) { balls.emplace_back().declare(opened); });
  }

  void MeshSection::declare_beam(Section &mesh, const int &dimension)
  {
    Section &s = mesh.section("Notched beam", "Along x from the origin, notched from below at mid-span; boundaries "
                                              "left, right, bottom, top, back, front, notch");
    s.only_if([this] { return source == Source::notched_beam; }, "Mesh/Source = notched beam");
    const auto solid  = [&dimension] { return dimension == 3; };
    const auto length = [&](const char *name, double &member, const char *meaning) -> Entry & {
      return s.number(name, member, "m", Range::positive(), Need::required).means(meaning);
    };
    length("Length", beam.length, "Along x");
    length("Height", beam.height, "Along y");
    length("Width", beam.width, "Along z").only_if(solid, "Model/Dimension = 3");
    length("Span", beam.span, "Between the supports, at whose places there are nodes");
    length("Notch depth", beam.notch_depth, "From below");
    length("Notch width", beam.notch_width, "There are nodes at both edges of its mouth");
    length("Band", beam.band, "Width of the band of fine elements around the notch");
    length("Fine size", beam.fine_size, "Largest edge of the elements in the band, and of all upwards");
    length("Coarse size", beam.coarse_size, "Largest edge along x beside the band");
    s.integer("Width divisions", beam_width_divisions, "", Range::between(1, 1e4), Need::optional)
      .means("Elements across")
      .only_if(solid, "Model/Dimension = 3");
  }

  void MeshSection::declare_plate(Section &mesh, const int &dimension)
  {
    Section &s = mesh.section("Plate with hole", "A quarter, around the origin; boundaries hole, left (x = 0), bottom "
                                                 "(y = 0), right, top, back, front");
    s.only_if([this] { return source == Source::plate_with_hole; }, "Mesh/Source = plate with hole");
    const auto solid = [&dimension] { return dimension == 3; };
    s.number("Radius", plate.radius, "m", Range::positive(), Need::required).means("Of the hole");
    s.number("Half width", plate.half_width, "m", Range::positive(), Need::required).means("Of the whole plate");
    s.number("Half height", plate.half_height, "m", Range::positive(), Need::required).means("Of the whole plate");
    s.number("Depth", plate.depth, "m", Range::positive(), Need::required)
      .means("Along z")
      .only_if(solid, "Model/Dimension = 3");
    s.integer("Radial divisions", radial_divisions, "", Range::between(1, 1e4), Need::optional)
      .means("Elements from the hole to the edge");
    s.integer("Angular divisions", angular_divisions, "", Range::between(2, 1e4), Need::optional)
      .means("Elements around the hole, an even number");
    s.integer("Depth divisions", depth_divisions, "", Range::between(1, 1e4), Need::optional)
      .means("Elements along z")
      .only_if(solid, "Model/Dimension = 3");
  }

  void MeshSection::check(const base::EntryPath &root, const int dimension) const
  {
    const base::EntryPath s = root.at("Mesh");
    if (source == Source::file && !std::filesystem::is_regular_file(file))
      s.refuse("File", "there is no such file (" + std::filesystem::absolute(file).lexically_normal().string() + ").");
    if (source == Source::cylinder && dimension == 2)
      s.refuse("Source", "a cylinder is a body in three dimensions, and Model/Dimension is 2. Take a box.");
    if (source == Source::box)
      require_edges(s.at("Box"), box_size, dimension);
    if (source == Source::bodies)
      check_bodies(s, dimension);
  }

  void MeshSection::check_bodies(const base::EntryPath &mesh, const int dimension) const
  {
    if (boxes.empty() && balls.empty())
      mesh.refuse("Source", "there is no body. Give each a section Mesh/Boxes/NAME or Mesh/Balls/NAME.");
    for (const BoxSection &box : boxes)
      require_edges(mesh.at("Boxes").at(box.name), box.size, dimension);
    for (const BallSection &ball : balls)
      if (ball.divisions % 2 != 0)
        mesh.at("Balls").at(ball.name).refuse("Divisions", "must be even.");
  }

  namespace
  {
    template <int dim>
    fem::Mesh<dim> mesh_in_file(const MeshSection &section, const MPI_Comm communicator)
    {
      fem::GmshReading how;
      how.bodies              = section.several_bodies ? fem::Bodies::several : fem::Bodies::one;
      how.doubled             = section.notch ? fem::DoubledNodes::notch : fem::DoubledNodes::refuse;
      how.unit                = section.length_unit.value_or(base::LengthUnit());
      fem::Mesh<dim>   mesh   = fem::read_gmsh<dim>(section.file, communicator, how);
      constexpr double large  = 30; // [m], without a word on the unit
      const auto       extent = fem::extent_of(mesh);
      for (int d = 0; d < dim; ++d)
        if (const double length = extent.high[d] - extent.low[d]; length > large && !section.length_unit)
          throw base::InputError(
            fmt::format("{}: the mesh is {:g} m long along {}. In mm? Set Mesh/Length unit = mm; if metres "
                        "are meant, m.",
                        section.file, length, "xyz"[d]));
      return mesh;
    }
  } // namespace

  template <int dim>
  fem::Mesh<dim> make_mesh(const MeshSection &mesh, const MPI_Comm communicator)
  {
    fem::ShapeOptions options;
    options.family       = mesh.family;
    options.refinements  = whole(mesh.refinements);
    options.communicator = communicator;
    switch (mesh.source)
      {
      case MeshSection::Source::file:
        {
          return mesh_in_file<dim>(mesh, communicator);
        }
      case MeshSection::Source::box:
        {
          fem::BoxShape box;
          box.size   = mesh.box_size;
          box.growth = mesh.box_growth;
          for (std::size_t i = 0; i < 3; ++i)
            box.divisions[i] = whole(mesh.box_divisions[i]);
          return fem::make_shape<dim>(box, options);
        }
      case MeshSection::Source::bodies:
        {
          fem::BodiesShape shape;
          for (const BoxSection &box : mesh.boxes)
            shape.boxes.push_back(box.box());
          for (const BallSection &ball : mesh.balls)
            shape.balls.push_back(ball.ball());
          return fem::make_shape<dim>(shape, options);
        }
      case MeshSection::Source::notched_beam:
        {
          fem::NotchedBeamShape beam = mesh.beam;
          beam.width_divisions       = whole(mesh.beam_width_divisions);
          return fem::make_shape<dim>(beam, options);
        }
      case MeshSection::Source::plate_with_hole:
        {
          fem::PlateWithHoleShape plate = mesh.plate;
          plate.radial_divisions        = whole(mesh.radial_divisions);
          plate.angular_divisions       = whole(mesh.angular_divisions);
          plate.depth_divisions         = whole(mesh.depth_divisions);
          return fem::make_shape<dim>(plate, options);
        }
      case MeshSection::Source::cylinder:
        {
          fem::CylinderShape bar = mesh.cylinder;
          bar.divisions          = whole(mesh.axial_divisions);
          return fem::make_shape<dim>(bar, options);
        }
      }
    throw std::logic_error("a source of meshes that nobody makes");
  }

  template fem::Mesh<2> make_mesh(const MeshSection &, MPI_Comm);
  template fem::Mesh<3> make_mesh(const MeshSection &, MPI_Comm);
} // namespace apps
