#include "dem/emission/emission.h"

namespace dem
{
  namespace
  {
    constexpr std::size_t numbers_of_event = 18, numbers_of_source = 16;

    void append(base::Column &row, const double *values, const std::size_t count)
    {
      row.insert(row.end(), values, values + count);
    }

    base::Column numbers_of(const std::vector<EmissionEvent> &events)
    {
      base::Column row;
      for (const EmissionEvent &e : events)
        {
          append(row, e.place.data(), 3);
          append(row, e.moment.data(), 9);
          row.insert(row.end(), {e.time, e.lasts, e.area, static_cast<double>(e.in_tension),
                                 static_cast<double>(e.in_shear), static_cast<double>(e.gradual)});
        }
      return row;
    }

    std::vector<EmissionEvent> events_of(const base::Column &row)
    {
      std::vector<EmissionEvent> events;
      for (std::size_t at = 0; at + numbers_of_event <= row.size(); at += numbers_of_event)
        {
          EmissionEvent e;
          e.place      = Eigen::Vector3d(&row[at]);
          e.moment     = Eigen::Matrix3d(&row[at + 3]);
          e.time       = row[at + 12];
          e.lasts      = row[at + 13];
          e.area       = row[at + 14];
          e.in_tension = static_cast<std::int64_t>(row[at + 15]);
          e.in_shear   = static_cast<std::int64_t>(row[at + 16]);
          e.gradual    = static_cast<std::int64_t>(row[at + 17]);
          events.push_back(e);
        }
      return events;
    }
  } // namespace

  void Emission::visit_state(base::StateVisitor &visitor)
  {
    if (!listens())
      return;
    base::Column              events = numbers_of(heard), numbers, places;
    std::vector<std::int32_t> bodies;
    for (const Source &s : sources)
      {
        append(numbers, s.origin.data(), 3);
        append(numbers, s.at_start.data(), 9);
        numbers.insert(numbers.end(), {static_cast<double>(s.event), s.ends, static_cast<double>(s.places.size()),
                                       static_cast<double>(s.body.size())});
        for (const Eigen::Vector3d &place : s.places)
          append(places, place.data(), 3);
        bodies.insert(bodies.end(), s.body.begin(), s.body.end());
      }
    auto taken_up = static_cast<std::int64_t>(logged);
    visitor.scalar("emission/logged", taken_up);
    visitor.column("emission/events", events);
    visitor.column("emission/sources", numbers);
    visitor.column("emission/places", places);
    visitor.column("emission/bodies", bodies);
    logged = static_cast<std::size_t>(taken_up);
    heard  = events_of(events);
    sources.clear();
    std::size_t place = 0, particle = 0;
    for (std::size_t at = 0; at + numbers_of_source <= numbers.size(); at += numbers_of_source)
      {
        Source s;
        s.origin   = Eigen::Vector3d(&numbers[at]);
        s.at_start = Eigen::Matrix3d(&numbers[at + 3]);
        s.event    = static_cast<std::size_t>(numbers[at + 12]);
        s.ends     = numbers[at + 13];
        for (auto n = static_cast<std::size_t>(numbers[at + 14]); n > 0; --n, place += 3)
          s.places.emplace_back(&places.at(place));
        const auto n = static_cast<std::size_t>(numbers[at + 15]);
        s.body.assign(&bodies.at(particle), &bodies.at(particle) + n);
        particle += n;
        sources.push_back(s);
      }
  }
} // namespace dem
