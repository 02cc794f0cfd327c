#include "apps/scene/parameter_lines.h"
#include "base/errors.h"

#include <nlohmann/json.hpp>

#include <iterator>
#include <map>

namespace apps
{
  namespace
  {
    /** Reads characters and counts the lines, since the JSON reader does not say where it is. */
    class CountingIterator
    {
    public:
      using difference_type   = std::ptrdiff_t;
      using value_type        = char;
      using pointer           = const char *;
      using reference         = const char &;
      using iterator_category = std::input_iterator_tag;

      CountingIterator(const char *start, int &line_count)
        : position(start)
        , line(&line_count)
      {
      }

      reference         operator*() const { return *position; }
      CountingIterator &operator++()
      {
        *line += *position == '\n' ? 1 : 0;
        ++position;
        return *this;
      }
      bool operator!=(const CountingIterator &other) const { return position != other.position; }
      bool operator==(const CountingIterator &other) const { return position == other.position; }

    private:
      const char *position;
      int        *line;
    };

    /** Receives what the JSON reader meets; a key is on the line where it was met, and so is its value. */
    class JsonScan : public nlohmann::json_sax<nlohmann::json>
    {
    public:
      JsonScan(std::string file_name, const int &current_line)
        : file(std::move(file_name))
        , line(current_line)
      {
      }

      std::vector<Assignment> found;

      bool key(string_t &name) override
      {
        current  = name;
        key_line = line;
        return true;
      }
      bool start_object(std::size_t) override
      {
        if (depth++ > 0)
          {
            if (sections.size() == deepest_section)
              throw base::InputError(Place{file, line}.text() + ": \"" + current + "\" lies within " +
                                     std::to_string(deepest_section) + " sections; no scene is as deep as that.");
            sections.push_back(current);
            found.push_back({sections, "", "", {file, line}});
          }
        return true;
      }
      bool end_object() override
      {
        if (--depth > 0)
          sections.pop_back();
        return true;
      }
      bool string(string_t &) override { return add(); }
      bool boolean(bool) override { return add(); }
      bool number_integer(number_integer_t) override { return add(); }
      bool number_unsigned(number_unsigned_t) override { return add(); }
      bool number_float(number_float_t, const string_t &) override { return add(); }
      bool null() override { refuse("null"); }
      bool binary(binary_t &) override { refuse("binary data"); }
      bool start_array(std::size_t) override { refuse("a list in brackets"); }
      bool end_array() override { return true; }
      bool parse_error(std::size_t, const std::string &token, const nlohmann::detail::exception &) override
      {
        throw base::InputError(Place{file, line}.text() + ": not valid JSON near \"" + token + "\".");
      }

    private:
      [[noreturn]] void refuse(const std::string &what) const
      {
        throw base::InputError(
          Place{file, line}.text() + ": \"" + current + "\" is " + what +
          ": expected a text, a number, true or false; lists are texts such as \"0.05, 0.05, 0.05\".");
      }

      bool add()
      {
        if (depth == 0)
          refuse("outside any braces");
        Assignment added{sections, current, "", {file, key_line}};
        const auto [first, fresh] = lines.emplace(added.path(), key_line);
        if (!fresh)
          throw base::InputError(added.place.text() + ": \"" + added.path() +
                                 "\" is set a second time; first in line " + std::to_string(first->second) +
                                 ". Keep one of them.");
        found.push_back(std::move(added));
        return true;
      }

      std::string                file;
      const int                 &line;
      int                        key_line = 0, depth = 0;
      std::string                current;
      std::vector<std::string>   sections;
      std::map<std::string, int> lines; ///< of each entry
    };
  } // namespace

  std::vector<Assignment> entries_of_json(std::istream &text, const std::string &file)
  {
    const std::string content(std::istreambuf_iterator<char>(text), {});
    int               line = 1;
    JsonScan          scan(file, line);
    const char       *start = content.data();
    nlohmann::json::sax_parse(CountingIterator(start, line), CountingIterator(start + content.size(), line), &scan);
    return std::move(scan.found);
  }
} // namespace apps
