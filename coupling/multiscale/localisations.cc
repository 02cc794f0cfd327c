#include "coupling/multiscale/localisations.h"

#include "coupling/multiscale/dealt_points.h"

#include <sstream>

namespace coupling
{
  std::string Localisation::text() const
  {
    std::ostringstream text;
    text << "the cell at " << place.transpose() << " has localised in state " << state << ", across the normal "
         << normal.transpose();
    return text.str();
  }

  void Localisations::add(const Localisation &localisation, const std::string &why)
  {
    found.push_back(localisation);
    if (!why.empty())
      end = why;
  }

  std::vector<std::string> Localisations::notes() const
  {
    std::vector<std::string> texts;
    for (const Localisation &localisation : found)
      texts.push_back(localisation.text());
    return texts;
  }

  void Localisations::visit_state(base::StateVisitor &visitor)
  {
    base::Column row;
    for (const Localisation &l : found)
      {
        row.insert(row.end(), l.place.begin(), l.place.end());
        row.insert(row.end(), l.normal.begin(), l.normal.end());
        row.push_back(static_cast<double>(l.state));
      }
    visitor.column("localisations", row);
    visit_text(visitor, "end", end);
    found.clear();
    for (std::size_t i = 0; i + 7 <= row.size(); i += 7)
      found.push_back({{row[i], row[i + 1], row[i + 2]},
                       {row[i + 3], row[i + 4], row[i + 5]},
                       static_cast<std::int64_t>(row[i + 6])});
  }
} // namespace coupling
