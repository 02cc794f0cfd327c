#include "apps/scene/usual_sizes.h"

#include "apps/text/same_name.h"
#include "apps/text/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace apps
{
  namespace
  {
    constexpr double beyond = std::numeric_limits<double>::infinity();

    /** Numbers that an entry of this unit, whose name has one of these words, hardly means. */
    struct Doubt
    {
      const char              *unit;
      std::vector<std::string> words;
      double                   above, below; ///< magnitudes between the two are in doubt
      const char              *question;
    };

    // The first that holds is the question. Bounds are generous: soft rubber has a modulus of 1e6 Pa, diamond one of 1.2e12 Pa. A strength or
    // limit that is far beyond all solids is a word, too: it never breaks.
    const std::vector<Doubt> &all_doubts()
    {
      static const std::vector<Doubt> doubts = {
        {"Pa", {"modulus"}, 0, 1e6, "no solid is so soft. In GPa or MPa? Write it in Pa, e.g. 25e9"},
        {"Pa", {"modulus"}, 1e13, beyond, "no solid is so stiff. In GPa or MPa? Write it in Pa, e.g. 25e9"},
        {"Pa", {"strength", "cohesion"}, 0, 1e3, "no solid is so weak. In MPa? Write it in Pa, e.g. 3e6"},
        {"Pa",
         {"stress", "pressure", "traction"},
         0,
         1e3,
         "a solid hardly feels so small a load. In MPa or kPa? Write it in Pa, e.g. 5e6"},
        {"Pa", {"stress", "pressure", "traction"}, 1e12, beyond, "no solid bears so much. Write it in Pa, e.g. 5e6"},
        {"kg/m^3", {"density"}, 0, 10, "no solid is so light. In t/m^3 or g/cm^3? Write it in kg/m^3, e.g. 2400"},
        {"kg/m^3", {"density"}, 3e4, beyond, "no solid is so heavy. Write it in kg/m^3, e.g. 2400"},
        {"-",
         {"friction"},
         9,
         90.001,
         "no two solids rub so hard. An angle in degrees? Write its tangent, e.g. 0.78 for 38 degrees"},
        {"degrees", {"angle"}, 0, 1.6, "that is a small angle. In radians? Write it in degrees, e.g. 38"},
        {"-",
         {"elastic strain"},
         0.1,
         1e3,
         "nothing that breaks stays elastic so far. In per mille or per cent? Write it as a pure number, e.g. 1e-4"},
        {"-",
         {"largest strain", "furthest strain"},
         0.5,
         beyond,
         "few tests go so far. In per cent? Write it as a pure number, e.g. 0.02"},
        {"m",
         {"particle radius", "mean radius", "gap"},
         0.4,
         beyond,
         "that is large for a particle. In mm? Write it in m, e.g. 1e-3"},
        {"m",
         {"smoothing depth", "glued layer", "skin thickness"},
         0.2,
         beyond,
         "it is a small part of a particle or of a specimen. In mm? Write it in m, e.g. 1e-4"},
        {"m",
         {"clearance", "crack opening", "notch width", "membrane ball", "grip thickness", "roller radius",
          "impactor radius", "support width", "fine size", "coarse size", "nonlocal length"},
         1,
         beyond,
         "that is large. In mm? Write it in m, e.g. 5e-3"},
        {"m", {"thickness"}, 5, beyond, "that is large. In mm? Write it in m, e.g. 0.05"},
        {"m",
         {"length", "height", "width", "span", "depth", "size", "half width", "half height"},
         30,
         beyond,
         "that is large. In mm? Write it in m, e.g. 0.1"},
        {"m", {"sizes", "classes"}, 0.4, beyond, "that is large for a grain. In mm? Write it in m, e.g. 8e-3"},
        {"m",
         {"upper", "lower", "corner", "first edge", "second edge", "centre", "point", "position", "from", "to"},
         30,
         beyond,
         "that is far away. In mm? Write it in m, e.g. 0.1"},
        {"m", {"displacement"}, 2, beyond, "that is far. In mm? Write it in m, e.g. 1e-3"},
        {"m/s", {"velocity"}, 999, beyond, "little is so fast. In mm/s? Write it in m/s, e.g. 5"},
        {"m", {"wavelengths"}, 300, beyond, "that is long. In mm? Write it in m, e.g. 0.16"},
        {"m", {"corners"}, 5, beyond, "that is large for a body of pebbles. In mm? Write it in m, e.g. 0.01"},
        {"-", {"instants"}, 0.5, beyond, "few tests go so far. In per cent? Write it as a pure number, e.g. -1e-3"},
        {"m/s", {"velocities"}, 300, beyond, "nothing falls so fast. In mm/s? Write it in m/s, e.g. 2"},
        {"m/s", {"speed"}, 10, beyond, "no press is so fast. In mm/s? Write it in m/s, e.g. 0.02"},
        {"1/s",
         {"strain rate", "back rate"},
         50,
         beyond,
         "few tests are so fast. In per mille or per cent a second? Write it in 1/s, e.g. 0.1"},
        {"s",
         {"end time", "longest time", "duration"},
         100,
         beyond,
         "that is long in steps of microseconds. In ms or us? Write it in s, e.g. 0.05"},
        {"m/s^2",
         {"acceleration"},
         5e3,
         2e4,
         "that is a thousand times the weight. In mm/s^2? Write it in m/s^2, e.g. 9.81"},
        {"m^2", {"area"}, 100, beyond, "that is large. In mm^2? Write it in m^2, e.g. 2.5e-3"},
        {"J/m^2", {"fracture energy"}, 0, 1, "about 100 is usual. In N/mm? Write it in J/m^2, e.g. 110 for 0.11 N/mm"},
        {"J/m^2", {"fracture energy"}, 1e7, beyond, "about 100 is usual. Write it in J/m^2"},
        {"N/m^3", {"x", "y", "z"}, 0, 100, "nothing is so light. In kN/m^3? Write it in N/m^3, e.g. 24e3"},
        {"N/m^3", {"stiffness"}, 0, 1e5, "nothing is so soft. In MPa/mm? Write it in N/m^3, e.g. 1e12 for 1000 MPa/mm"},
        {"Pa/m", {"stiffness"}, 0, 1e5, "nothing is so soft. In MPa/mm? Write it in Pa/m, e.g. 1e12 for 1000 MPa/mm"}};
      return doubts;
    }
  } // namespace

  namespace
  {
    template <typename Applies>
    std::string question_of(const std::string &entry,
                            const std::string &unit,
                            const double       value,
                            const std::string &written,
                            const Applies     &applies)
    {
      const double size = std::abs(value);
      for (const Doubt &doubt : all_doubts())
        if (unit == doubt.unit && applies(doubt) && size > doubt.above && size < doubt.below)
          for (const std::string &words : doubt.words)
            if (has_words(entry, words))
              return fmt::format("{}. If it is meant, name the unit: {} {}", doubt.question, written, unit);
      return "";
    }

    bool is_of_loads(const std::string &unit) { return unit == "Pa" || unit == "N/m^3"; }
  } // namespace

  std::string
  question_about(const std::string &entry, const std::string &unit, const double value, const std::string &written)
  {
    return question_of(entry, unit, value, written, [](const Doubt &) { return true; });
  }

  std::string question_about_growing(const std::string &entry,
                                     const std::string &unit,
                                     const double       largest,
                                     const std::string &written)
  {
    return question_of(entry, unit, largest, written,
                       [](const Doubt &doubt) { return doubt.above == 0 && is_of_loads(doubt.unit); });
  }

  namespace
  {
    /** The numbers in a part of a list: one, or two between which stands a minus (not that of a number) or an arrow. */
    std::vector<double> numbers_of(const std::string &part)
    {
      for (std::size_t at = 1; at < part.size(); ++at)
        if (part[at] == '>' || (part[at] == '-' && std::string("eE> ").find(part[at - 1]) == std::string::npos))
          {
            const auto one = number_in(trimmed(part.substr(0, at))), other = number_in(trimmed(part.substr(at + 1)));
            return one && other ? std::vector<double>{*one, *other} : std::vector<double>{};
          }
      const auto only = number_in(part);
      return only ? std::vector<double>{*only} : std::vector<double>{};
    }

    struct ListPart
    {
      std::string numbers, rest; ///< before the colon, without unit; from it on
      std::string separator;     ///< that follows
      bool        unit_named = false;
    };

    /** Parts between commas, and with corners between semicolons, too. */
    std::vector<ListPart> parts_between(const std::string &written)
    {
      std::vector<ListPart> parts;
      for (std::size_t begin = 0; begin <= written.size();)
        {
          const std::size_t end   = std::min(written.find_first_of(",;", begin), written.size());
          const std::string text  = trimmed(written.substr(begin, end - begin));
          const std::size_t colon = std::min(text.find(':'), text.size());
          parts.push_back({trimmed(text.substr(0, colon)), text.substr(colon), written.substr(end, 1)});
          begin = end + 1;
        }
      return parts;
    }

    std::vector<ListPart> parts_of(const std::string &written, const std::string &unit)
    {
      const std::string     ending = " " + unit;
      std::vector<ListPart> parts  = parts_between(written);
      for (ListPart &part : parts)
        {
          const std::size_t end = part.numbers.size() > ending.size() ? part.numbers.size() - ending.size() : 0;
          part.unit_named       = end > 0 && part.numbers.compare(end, ending.size(), ending) == 0;
          if (part.unit_named)
            part.numbers = trimmed(part.numbers.substr(0, end));
        }
      return parts;
    }
  } // namespace

  std::string question_about_list(const std::string &entry, const std::string &unit, const std::string &written)
  {
    for (const ListPart &part : parts_of(written, unit))
      if (!part.unit_named)
        for (const double value : numbers_of(part.numbers))
          if (std::string question = question_about(entry, unit, value, part.numbers); !question.empty())
            return question + part.rest;
    return "";
  }

  std::string list_without_units(const std::string &written, const std::string &unit)
  {
    std::string plain;
    for (const ListPart &part : parts_of(written, unit))
      plain += part.numbers + part.rest + part.separator + (part.separator.empty() ? "" : " ");
    return plain;
  }
} // namespace apps
