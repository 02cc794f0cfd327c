// Runs a scene in this process and reads a figure of its result, without a file of results.
#include <apps/results/run_result.h>
#include <apps/scene/kinds/read_scene.h>
#include <base/errors.h>

#include <cstdio>

int main(const int count, const char *const *arguments)
try
  {
    if (count != 3)
      throw base::InputError("usage: run_a_scene SCENE FIGURE");
    const apps::CheckedScene scene   = apps::read_scene(arguments[1], {});
    apps::RunRequest         request = apps::request_of(scene);
    request.output_folder.clear();
    const apps::RunResult result = scene.scene->run(request);
    const apps::Figure    figure = result.figure(arguments[2]);
    if (!figure.value)
      return 1;
    std::printf("%s = %.6g %s\n", arguments[2], *figure.value, figure.unit.c_str());
    return 0;
  }
catch (const base::InputError &refused)
  {
    std::fprintf(stderr, "%s\n", refused.what());
    return 2;
  }
