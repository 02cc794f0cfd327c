#include "apps/scene/parameter_lines.h"

#include "apps/text/value_text.h"
#include "base/errors.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace apps
{
  namespace
  {
    std::string lower_case(std::string word)
    {
      std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char c) { return std::tolower(c); });
      return word;
    }

    /** Runs of blanks become one, as ParameterHandler does with names. */
    std::string single_spaced(const std::string &text)
    {
      std::string result;
      for (const char c : trimmed(text))
        {
          const bool blank = c == ' ' || c == '\t';
          if (!blank || result.back() != ' ')
            result += blank ? ' ' : c;
        }
      return result;
    }

    class PrmScan
    {
    public:
      explicit PrmScan(std::string file_name)
        : file(std::move(file_name))
      {
      }

      void line(const std::string &text, const int number)
      {
        const auto        blank = text.find_first_of(" \t");
        const std::string verb  = lower_case(text.substr(0, blank));
        const std::string rest  = blank == std::string::npos ? "" : trimmed(text.substr(blank));
        if (verb == "subsection" && !rest.empty())
          enter(single_spaced(rest), number);
        else if (verb == "end" && rest.empty())
          leave(number);
        else if (verb == "set" && rest.find('=') != std::string::npos && rest[0] != '=')
          add(single_spaced(rest.substr(0, rest.find('='))), number);
        else
          refuse(number, "\"" + text +
                           "\" is not understood: expected \"set KEY = VALUE\", \"subsection NAME\", \"end\" or a "
                           "comment \"# ...\".");
      }

      std::vector<Assignment> finish() const
      {
        if (!sections.empty())
          refuse(sections.back().line, "subsection \"" + sections.back().name + "\" is not closed. Add its \"end\".");
        return found;
      }

    private:
      struct Open
      {
        std::string name;
        int         line;
      };

      [[noreturn]] void refuse(const int number, const std::string &message) const
      {
        throw base::InputError(Place{file, number}.text() + ": " + message);
      }

      std::vector<std::string> path() const
      {
        std::vector<std::string> names;
        for (const Open &open : sections)
          names.push_back(open.name);
        return names;
      }

      void enter(const std::string &section, const int number)
      {
        if (sections.size() == deepest_section)
          refuse(number, "subsection \"" + section + "\" lies within " + std::to_string(deepest_section) +
                           " others; no scene is as deep as that. Is an \"end\" missing?");
        sections.push_back({section, number});
        found.push_back({path(), "", "", {file, number}});
      }

      void leave(const int number)
      {
        if (sections.empty())
          refuse(number, "\"end\" closes no subsection. Remove it, or add the \"subsection\" it belongs to.");
        sections.pop_back();
      }

      void add(const std::string &entry, const int number)
      {
        Assignment added{path(), entry, "", {file, number}};
        const auto [first, fresh] = lines.emplace(added.path(), number);
        if (!fresh)
          refuse(number, "\"" + added.path() + "\" is set a second time; first in line " +
                           std::to_string(first->second) + ". Keep one of them.");
        found.push_back(std::move(added));
      }

      std::string                file;
      std::vector<Open>          sections;
      std::vector<Assignment>    found;
      std::map<std::string, int> lines; ///< of each entry
    };
  } // namespace

  std::vector<Assignment> entries_of_prm(std::istream &text, const std::string &file)
  {
    PrmScan     scan(file);
    std::string pending; // of lines that end in a backslash
    int         number = 0, start = 1;
    for (std::string raw; std::getline(text, raw);)
      {
        ++number;
        std::string line = trimmed(raw.substr(0, raw.find('#')));
        if (pending.empty())
          start = number;
        const bool continues = !line.empty() && line.back() == '\\';
        if (continues)
          line.pop_back();
        pending += line;
        if (continues)
          continue;
        if (!trimmed(pending).empty())
          scan.line(trimmed(pending), start);
        pending.clear();
      }
    return scan.finish();
  }
} // namespace apps
