#include "apps/commands/command.h"
#include "apps/process/exit_status.h"
#include "apps/scene/description.h"
#include "apps/scene/kinds/read_scene.h"
#include "base/errors.h"
#include "postprocess/files/atomic_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace apps
{
  namespace
  {
    struct NewOptions
    {
      std::string kind, file;
    };

    int begin_scene(const NewOptions &options)
    {
      const CheckedScene          scene = declare_scene(options.kind);
      const std::filesystem::path file  = options.file.empty() ? scene.kind + ".prm" : options.file;
      if (std::filesystem::exists(file))
        throw base::InputError(file.string() + ": is there already; -o FILE writes another one.");
      postprocess::write_text(file, proposed_scene(*scene.root, scene.kind));
      fmt::print("{}: every entry of kind {}, as comments. What must be given: breccia check {}\n", file.string(),
                 scene.kind, file.string());
      return exit_success;
    }
  } // namespace

  void add_new(CLI::App &program, Action &chosen)
  {
    const auto options = std::make_shared<NewOptions>();
    CLI::App  &command = *program.add_subcommand("new", "A scene to start from: every entry of a kind, explained");
    command.add_option("kind", options->kind, "Kind of scene; \"breccia describe Kind\" says what there is")
      ->required()
      ->type_name("KIND");
    command.add_option("-o,--output", options->file, "The scene; default: KIND.prm")->type_name("FILE.prm");
    command.callback([options, &chosen] { chosen = [options] { return begin_scene(*options); }; });
  }
} // namespace apps
