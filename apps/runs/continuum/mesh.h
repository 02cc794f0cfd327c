#pragma once

#include "apps/runs/continuum/mesh_mix.h"
#include "base/entry_path.h"
#include "base/length_unit.h"
#include "fem/mesh/shape_sizes.h"

#include <mpi.h>

#include <array>
#include <cstdint>
#include <list>
#include <optional>
#include <string>

namespace fem
{
  template <int dim>
  struct Mesh;
}

namespace apps
{
  /** Sub-section of "Boxes": a body of its own. */
  struct BoxSection
  {
    std::string                 name, material = "solid";
    std::array<double, 3>       corner{}, size{};
    std::array<std::int64_t, 3> divisions{1, 1, 1};

    fem::NamedBox box() const;
  };

  /** Sub-section of "Balls": a body of its own. */
  struct BallSection
  {
    std::string           name, material = "solid";
    std::array<double, 3> centre{}, towards{};
    double                radius = 0, fineness = 1;
    std::int64_t          divisions = 8;

    fem::NamedBall ball() const;
  };

  /** Section "Mesh": a file of Gmsh, or a built-in shape. */
  struct MeshSection
  {
    enum class Source
    {
      file,
      box,
      bodies,
      notched_beam,
      plate_with_hole,
      cylinder
    };

    Source                          source = Source::file;
    std::string                     file;
    bool                            several_bodies = false;
    bool                            notch          = false; ///< doubled nodes are its faces
    std::optional<base::LengthUnit> length_unit;            ///< of the file; empty: not given
    fem::ElementFamily              family      = fem::ElementFamily::hypercube;
    std::int64_t                    refinements = 0;
    std::array<double, 3>           box_size{};
    std::array<std::int64_t, 3>     box_divisions{1, 1, 1};
    std::array<double, 3>           box_growth{1, 1, 1};
    std::list<BoxSection>           boxes;
    std::list<BallSection>          balls;
    fem::NotchedBeamShape           beam;
    std::int64_t                    beam_width_divisions = 4;
    fem::PlateWithHoleShape         plate;
    std::int64_t                    radial_divisions = 16, angular_divisions = 16, depth_divisions = 1;
    fem::CylinderShape              cylinder;
    std::int64_t                    axial_divisions = 8;
    MeshMixSection                  mix; ///< of which groups of elements are

    void check(const base::EntryPath &root, int dimension) const;

  private:
    void check_bodies(const base::EntryPath &mesh, int dimension) const;
  };

  /** @param communicator of the ranks it is spread over @throws base::InputError on a file or measures that give no sound mesh. */
  template <int dim>
  fem::Mesh<dim> make_mesh(const MeshSection &mesh, MPI_Comm communicator);
} // namespace apps
