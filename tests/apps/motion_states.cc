// What a motion of a solid must remember to go on to the same bits, pushed and driven from outside.
#include "apps/process/mpi_session.h"
#include "apps/runs/continuum/model.h"
#include "apps/runs/continuum/motion.h"
#include "apps/runs/continuum/solid.h"
#include "apps/scene/kinds/read_scene.h"
#include "apps/scene/scene_of.h"
#include "tests/apps/scratch_folder.h"
#include "tests/dem/memory_state.h"

#include <catch2/catch.hpp>

using namespace apps_tests;

namespace
{
  /** A square of 1 m that falls, damped, is pushed at one displacement and driven at another, anew in every step. */
  struct PushedSquare
  {
    PushedSquare()
      : scene((apps::start_mpi(),
               apps::read_scene(folder.file("square.prm", R"(set Kind = continuum
subsection Model
  set Dimension = 2
  set Analysis  = explicit
  set Thickness = 0.1
end
subsection Mesh
  set Source = box
  subsection Box
    set Size        = 1, 1, 0
    set Divisions x = 2
    set Divisions y = 2
  end
end
subsection Materials
  subsection solid
    set Law     = isotropic elastic
    set Density = 2400
    subsection isotropic elastic
      set Young modulus = 2e9
      set Poisson ratio = 0.2
    end
  end
end
subsection Motion
  set End time = 1
  set Damping  = 100
end
)"),
                                {})))
      , model(dynamic_cast<const apps::SceneOf<apps::ContinuumModel> &>(*scene.scene).model())
      , solid(apps::make_solid<2>(model))
      , motion(apps::make_motion<2>(*solid, model, {0, -9.81, 0}))
    {
    }

    void advance(const int steps)
    {
      for (int k = 0; k < steps; ++k)
        {
          motion->add_force(3, 1e4 * (1 + 1e3 * motion->time()));
          motion->prescribe(6, 0.1);
          motion->advance(motion->step());
          motion->clear_forces();
        }
    }

    ScratchFolder                           folder;
    apps::CheckedScene                      scene;
    const apps::ContinuumModel             &model;
    std::unique_ptr<fem::Solid<2>>          solid;
    std::unique_ptr<fem::ExplicitSolver<2>> motion;
  };
} // namespace

TEST_CASE("A motion that is pushed and driven goes on from its state to the same bits, its energy account too",
          "[apps][S13]")
{
  PushedSquare whole, resumed;
  whole.advance(20);
  MemoryState         memory;
  MemoryState::Writer writer(memory);
  apps::visit_motion(writer, *whole.motion, *whole.solid);
  MemoryState::Reader reader(memory);
  apps::visit_motion(reader, *resumed.motion, *resumed.solid);
  for (PushedSquare *square : {&whole, &resumed})
    square->advance(20);
  const fem::ExplicitEnergy &all = whole.motion->energy(), &rest = resumed.motion->energy();
  CHECK(all.external > 0);
  CHECK(rest.external == all.external);
  CHECK(rest.kinetic == all.kinetic);
  CHECK(rest.internal == all.internal);
  CHECK(rest.damped == all.damped);
  CHECK(rest.start == all.start);
  for (unsigned int i = 0; i < whole.motion->displacement().locally_owned_size(); ++i)
    {
      CHECK(resumed.motion->displacement().local_element(i) == whole.motion->displacement().local_element(i));
      CHECK(resumed.motion->velocity().local_element(i) == whole.motion->velocity().local_element(i));
    }
}
