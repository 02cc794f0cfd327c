#include "apps/runs/continuum/mesh.h"

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
    void require_edges(const base::EntryPath &box, const std::array<double, 3> &size, const int dimension)
    {
      for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
        if (!(size[i] > 0))
          box.refuse("Size", std::string("its edge along ") + "xyz"[i] + " must be positive.");
    }

    unsigned int whole(const std::int64_t number) { return static_cast<unsigned int>(number); }
  } // namespace

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
    mix.mix.check_for_cell(s);
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

  namespace
  {
    template <int dim>
    fem::Mesh<dim> built_mesh(const MeshSection &mesh, const MPI_Comm communicator)
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
      throw std::logic_error("a source of meshes without a builder");
    }
  } // namespace

  template <int dim>
  fem::Mesh<dim> make_mesh(const MeshSection &mesh, const MPI_Comm communicator)
  {
    fem::Mesh<dim> made = built_mesh<dim>(mesh, communicator);
    if (mesh.mix.given())
      mesh.mix.share_out(made);
    return made;
  }

  template fem::Mesh<2> make_mesh(const MeshSection &, MPI_Comm);
  template fem::Mesh<3> make_mesh(const MeshSection &, MPI_Comm);
} // namespace apps
