#include "apps/figures/emission_figures.h"

#include "apps/figures/summary_head.h"
#include "apps/results/warning.h"
#include "dem/emission/frequency_law.h"
#include "dem/emission/moment_tensor.h"
#include "postprocess/pictures/emission_picture.h"
#include "postprocess/vtk/emission_events.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace apps
{
  namespace
  {
    nlohmann::json without(const std::string &reason)
    {
      return {{"value", nullptr}, {"unit", "-"}, {"not_determined", reason}};
    }
  } // namespace

  EmissionFigures::EmissionFigures(const dem::ObservedSpecimen &specimen)
    : heard(specimen.parameters().emission_reach > 0)
    , events(static_cast<double>(specimen.emission().size()))
  {
    const std::vector<double> magnitudes = dem::magnitudes_of(specimen.emission());
    if (!magnitudes.empty())
      largest = *std::max_element(magnitudes.begin(), magnitudes.end());
    if (const auto law = dem::frequency_law(magnitudes))
      {
        of_law       = static_cast<double>(law->events);
        completeness = law->completeness;
        b            = law->b;
        error        = law->error;
      }
  }

  EmissionFigures::EmissionFigures(const base::Column &row)
    : heard(!row.empty())
  {
    if (!heard)
      return;
    events       = row.at(0);
    largest      = row.at(1);
    of_law       = row.at(2);
    completeness = row.at(3);
    b            = row.at(4);
    error        = row.at(5);
  }

  base::Column EmissionFigures::row() const
  {
    return heard ? base::Column{events, largest, of_law, completeness, b, error} : base::Column{};
  }

  std::vector<std::string> EmissionFigures::names(const std::string &prefix)
  {
    return {prefix + "emission_events", prefix + "emission_largest_magnitude", prefix + "emission_b_value"};
  }

  nlohmann::json EmissionFigures::json(const std::string &prefix) const
  {
    nlohmann::json found = nlohmann::json::object();
    if (!heard)
      return found;
    const std::vector<std::string> name = names(prefix);
    found[name[0]]                      = quantity(events, "");
    found[name[1]]                      = events > 0 ? quantity(largest, "-") : without("nothing broke");
    if (of_law > 0)
      {
        found[name[2]]                   = quantity(b, "-");
        found[name[2]]["standard_error"] = error;
        found[name[2]]["completeness"]   = completeness;
        found[name[2]]["events"]         = of_law;
      }
    else
      found[name[2]] =
        without(fmt::format("{} events from the most frequent magnitude on are needed", dem::fewest_events_of_law));
    return found;
  }

  std::string EmissionFigures::text() const
  {
    if (!heard)
      return "";
    std::string text = fmt::format("emission     {:.0f} events", events);
    if (events > 0)
      text += fmt::format(", the largest of magnitude {:.2f}", largest);
    if (of_law > 0)
      text += fmt::format(", b = {:.2f} +- {:.2f} of {:.0f} from {:.1f} on", b, error, of_law, completeness);
    return text + "\n";
  }

  void write_emission(const dem::ObservedSpecimen &specimen,
                      const std::filesystem::path &folder,
                      const std::string           &name,
                      const int                    looking_along)
  {
    if (!(specimen.parameters().emission_reach > 0))
      return;
    const std::vector<dem::EmissionEvent> &events = specimen.emission();
    postprocess::write_emission_table(folder / (name + "events.csv"), events);
    postprocess::write_vtk_emission(folder / (name + "emission.vtp"), events);
    if (!events.empty())
      warn_of_missing(name + "emission.png",
                      postprocess::picture_of_emission(folder / (name + "emission.png"), events, looking_along));
  }
} // namespace apps
