#include "apps/scene/parameter_file.h"

#include "apps/scene/page_scene.h"
#include "apps/scene/parameter_lines.h"
#include "base/errors.h"

#include <deal.II/base/parameter_handler.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace apps
{
  namespace
  {
    bool is_json(const std::string &file) { return std::filesystem::path(file).extension() == ".json"; }

    std::string content_of(const std::string &file)
    {
      const std::string extension = std::filesystem::path(file).extension().string();
      if (extension != ".prm" && extension != ".json" && !is_page(file))
        throw base::InputError(file + ": a scene's name ends in .prm or .json, that of a run's page in .html.");
      std::ifstream stream(file);
      if (!stream || std::filesystem::is_directory(file))
        throw base::InputError(file + ": cannot be opened: " +
                               (stream ? std::string("it is a folder") : std::string(std::strerror(errno))) + ".");
      std::ostringstream text;
      text << stream.rdbuf();
      const std::string     content         = text.str();
      constexpr const char *byte_order_mark = "\xEF\xBB\xBF"; // which some editors put before a text
      return content.compare(0, 3, byte_order_mark) == 0 ? content.substr(3) : content;
    }

    /** What an exception of deal.II says, without the banner around it. */
    std::string plain_message(const dealii::ExceptionBase &exception)
    {
      std::ostringstream text;
      exception.print_info(text);
      return text.str();
    }
  } // namespace

  std::vector<Assignment> read_parameter_file(const std::string &file)
  {
    std::string               text = content_of(file);
    postprocess::PageContents page;
    if (is_page(file))
      {
        page = postprocess::read_page_contents(text, file);
        text = page.scene;
      }
    std::istringstream      scanned(text), parsed(text);
    std::vector<Assignment> found = is_json(file) ? entries_of_json(scanned, file) : entries_of_prm(scanned, file);

    dealii::ParameterHandler handler;
    for (const Assignment &assignment : found)
      {
        for (const std::string &section : assignment.sections)
          handler.enter_subsection(section);
        if (!assignment.opens_section())
          handler.declare_entry(assignment.entry, "", dealii::Patterns::Anything());
        for (std::size_t i = 0; i < assignment.sections.size(); ++i)
          handler.leave_subsection();
      }
    try
      {
        if (is_json(file))
          handler.parse_input_from_json(parsed);
        else
          handler.parse_input(parsed, file);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        throw base::InputError(file + ": cannot be read: " + plain_message(exception));
      }
    for (Assignment &assignment : found)
      if (!assignment.opens_section())
        assignment.value = handler.get(assignment.sections, assignment.entry);
    use_files_of_page(page, file, found);
    return found;
  }
} // namespace apps
