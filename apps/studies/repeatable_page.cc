#include "apps/studies/repeatable_page.h"

#include "apps/results/run_report.h"
#include "apps/scene/description.h"
#include "apps/scene/kinds/read_scene.h"
#include "base/errors.h"

#include <filesystem>
#include <optional>

namespace apps
{
  namespace
  {
    bool is_scene(const std::string &file)
    {
      const std::string extension = std::filesystem::path(file).extension().string();
      return extension == ".prm" || extension == ".json";
    }

    /** A scene with its files; nothing for one that is refused without what the study changes. */
    std::optional<std::string> scene_as_page(const std::string &file)
    {
      try
        {
          const CheckedScene    scene   = read_scene(file, {});
          const RunRequest      request = request_of(scene);
          postprocess::HtmlPage page("Scene " + std::filesystem::path(file).filename().string());
          add_scene(page, request.scene_text, request.inputs);
          return page.text();
        }
      catch (const base::InputError &)
        {
          return std::nullopt;
        }
    }
  } // namespace

  void add_to_repeat(postprocess::HtmlPage &page, const Section &root)
  {
    const std::string text = completed_scene(root, Completed::everything);
    page.scene(text);
    for (const InputFile &input : inputs_of(root))
      if (!is_scene(input.file))
        page.attach(input.entry, name_in(text, input), input.file);
      else if (const auto own = scene_as_page(input.file);
               !own || !page.attach_page(input.entry, name_in(text, input), *own))
        page.require(input.entry, name_in(text, input), input.file); // its own files lie beside it
    page.paragraph("The same table again: breccia run report.html -o FOLDER");
  }
} // namespace apps
