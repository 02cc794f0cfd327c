// A solid that takes its material from the particles inside it.
#include "apps/runs/coupled/particle_medium.h"

#include "apps/process/mpi_session.h"
#include "apps/runs/coupled/model.h"
#include "apps/runs/structure/model.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "dem/packing/lattice.h"
#include "tests/apps/scene_runs.h"
#include "tests/places.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace apps_tests;
using Catch::Contains;

namespace
{
  std::string cpm(const std::string &modulus)
  {
    return R"(
    set Law = CPM
    subsection CPM
      set Normal modulus       = )" +
           modulus + R"(
      set Shear ratio          = 0.2
      set Limit elastic strain = 1 -
      set Relative ductility   = 30
      set Cohesion             = 3e6
      set Friction coefficient = 0.8
    end
  end
)";
  }

  /** One half of the bar's elements, from x to the right, in a group of its own. */
  std::string box(const std::string &name, const std::string &x)
  {
    return R"(
      subsection )" +
           name + R"(
        set Corner      = )" +
           x + R"(, 0, 0
        set Size        = 0.02, 0.01, 0.01
        set Divisions x = 4
        set Divisions y = 2
        set Divisions z = 2
        set Material    = )" +
           name + R"(
      end)";
  }

  std::string homogenised(const std::string &group)
  {
    return R"(
    subsection )" +
           group + R"(
      set Law = anisotropic elastic
      subsection anisotropic elastic
        set Homogenised = true
      end
    end)";
  }

  std::string particles_of_two()
  {
    return R"(
set Kind = structure
subsection Specimen
  set Source            = generator
  set Box size          = 0.04, 0.01, 0.01
  set Interaction ratio = 1.5
  subsection Generator
    set Particle radius = 0.001
    set Cell particles  = 200
  end
end
subsection Materials
  subsection strong)" +
           cpm("24e9") + "  subsection weak" + cpm("8e9") + R"(end
subsection Regions
  subsection right half
    set Material = weak
    set Shape    = box
    set Lower    = 0.02, -1, -1
    set Upper    = 1, 1, 1
  end
end
)";
  }

  /** A bar of two materials, one half of its elements in a group of its own, particles in the middle. */
  std::string bar_of_two()
  {
    return particles_of_two() + R"(subsection Continuum
  subsection Model
    set Dimension = 3
  end
  subsection Mesh
    set Source = bodies
    subsection Boxes)" +
           box("left", "0") + box("right", "0.02") + R"(
    end
  end
  subsection Materials)" +
           homogenised("left") + homogenised("right") + R"(
  end
  subsection Boundary conditions
    subsection left left
      set Displacement x = 0
      set Displacement y = 0
      set Displacement z = 0
    end
    subsection right right
      set Displacement x = t
    end
  end
end
subsection Handshakes
  subsection middle
    set Low     = 0.015, -1, -1
    set High    = 0.025, 1, 1
    set Overlap = 0.005
  end
end
subsection Path
  set End  = 1e-6
  set Step = 1e-6
end
)";
  }
} // namespace

TEST_CASE("A hexagonal plane is the medium that the published example says, and reflects what it says",
          "[apps][volume]")
{
  apps::start_mpi();
  const apps::CheckedScene  read         = apps::read_scene(places::scene("beam_with_core.prm"), {});
  const apps::CoupledModel &model        = dynamic_cast<const apps::SceneOf<apps::CoupledModel> &>(*read.scene).model();
  const std::optional<dem::Packing> cell = dem::make_lattice(dem::Lattice::hexagonal, 5e-3, {6, 6, 1});
  const apps::ParticleMedia         media = model.media(cell);
  const coupling::ParticleMedium   *found = media.of("concrete");
  REQUIRE(found != nullptr);
  const auto  &D  = found->stiffness;
  const double nu = D(0, 1) / D(0, 0), E = (1 - nu * nu) * D(0, 0);
  CHECK(E == Approx(1.0464e9).epsilon(1e-3));
  CHECK(nu == Approx(0.2308).epsilon(1e-3));
  CHECK(D(5, 5) == Approx(E / (2 * (1 + nu))).epsilon(1e-6));
  CHECK(D(0, 5) == Approx(0).margin(1e-6 * E));
  CHECK(found->density == Approx(1813.8).epsilon(1e-4));
  constexpr double lambda = 1e9 * 0.2 / (1.2 * 0.6), mu = 1e9 / 2.4;
  base::Stiffness  solid = base::Stiffness::Zero();
  solid.topLeftCorner<3, 3>().setConstant(lambda);
  for (int c = 0; c < 6; ++c)
    solid(c, c) += c < 3 ? 2 * mu : mu;
  const coupling::Mismatch reflects = coupling::reflected_by_mismatch(*found, solid, 2000, {2, fem::Plane::stress});
  CHECK(reflects.compression == Approx(9e-5).margin(5e-6));
  CHECK(coupling::difference_of_stiffness(*found, D, {2, fem::Plane::stress}) == 0);
}

TEST_CASE("Elements in a region of another material of the particles are as stiff as its particles are",
          "[apps][structure][volume][slow]")
{
  const ScratchFolder folder;
  folder.file("bar.prm", bar_of_two());
  apps::start_mpi();
  const apps::CheckedScene    read  = apps::read_scene((folder / "bar.prm").string(), {});
  const apps::StructureModel &model = dynamic_cast<const apps::SceneOf<apps::StructureModel> &>(*read.scene).model();
  std::optional<dem::Packing> cell;
  model.packing(&cell);
  const apps::ParticleMedia media = model.media(cell);
  REQUIRE(media.of("left") != nullptr);
  REQUIRE(media.of("right") != nullptr);
  const auto &strong = media.of("left")->stiffness, &weak = media.of("right")->stiffness;
  CHECK((3 * weak - strong).norm() < 1e-6 * strong.norm()); // moduli alone make the difference
  CHECK(strong(0, 0) > 1e9);

  const Results found = results_of(folder, (folder / "bar.prm").string(), {}, {"control"});
  CHECK(found.summary["medium"]["difference_of_stiffness"]["value"] == 0);
  CHECK_THAT(content_of(folder / "results/homogenised.json"), Contains("\"groups\""));

  const ScratchFolder empty;
  is_refused(empty, (folder / "bar.prm").string(), {"Regions/right half/Lower=0.028, -1, -1"}, "several materials");
}
