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
    /** A scene with its files; nothing for another file, and for a scene that is none without what the study changes. */
    std::optional<std::string> scene_as_page(const std::string &file)
    {
      const std::string extension = std::filesystem::path(file).extension().string();
      if (extension != ".prm" && extension != ".json")
        return std::nullopt;
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
      if (const auto own = scene_as_page(input.file);
          !own || !page.attach_page(input.entry, name_in(text, input), *own))
        page.attach(input.entry, name_in(text, input), input.file);
    page.paragraph("The same table again: breccia run report.html -o FOLDER");
  }
} // namespace apps
