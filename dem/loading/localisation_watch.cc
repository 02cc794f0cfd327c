#include "dem/loading/localisation_watch.h"

#include <algorithm>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr double surely_not_chance = 1e-3; ///< Rayleigh test

    std::vector<double> lost_strength(const ObservedSpecimen &specimen)
    {
      const LinkOutput    links = specimen.links();
      std::vector<double> sum(specimen.counts().particles, 0.0);
      for (std::size_t l = 0; l < links.ends.size(); ++l)
        if (links.kind[l] != LinkOutput::contact)
          for (const std::size_t end : links.ends[l])
            sum[end] += 0.5 * links.strength_damage[l];
      return sum;
    }

    double second_order_work(const LocalisationWatch::Sample &from, const LocalisationWatch::Sample &to)
    {
      return (to.stress - from.stress).dot(to.strain - from.strain);
    }
  } // namespace

  std::optional<Band> LocalisationWatch::update(const ObservedSpecimen &specimen, const Sample &now)
  {
    const Sample before = std::exchange(last, now);
    if (has_localised != 0 || samples++ == 0)
      return std::nullopt;
    const bool damages = now.dissipated > before.dissipated;
    if (!damages && has_onset == 0)
      return std::nullopt;
    // What is lost does not change but by damage.
    const std::vector<double> earlier = damages ? std::exchange(lost, lost_strength(specimen)) : lost;
    if (has_onset != 0 && damages && second_order_work(at_onset, now) > 0)
      has_onset = 0; // the stress has risen past it: a wave, not a peak
    if (has_onset == 0 && damages && second_order_work(before, now) < 0)
      {
        has_onset     = 1;
        onset_number  = samples - 2;
        at_onset      = before;
        lost_at_onset = earlier;
      }
    if (has_onset == 0)
      return std::nullopt;
    std::vector<double> since = lost;
    for (std::size_t i = 0; i < lost_at_onset.size(); ++i)  // none before the first damage
      since[i] = std::max(lost[i] - lost_at_onset[i], 0.0); // below 0 by round-off only
    const Band band = strongest_band(specimen.cell().base, specimen.kinematics().position, since,
                                     specimen.parameters().physics.dimension);
    if (!(band.concentration > localised_above && band.by_chance < surely_not_chance))
      return std::nullopt;
    has_localised = 1;
    return band;
  }

  void LocalisationWatch::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("watch/samples", samples);
    visitor.scalar("watch/onset_number", onset_number);
    visitor.scalar("watch/has_onset", has_onset);
    visitor.scalar("watch/has_localised", has_localised);
    base::Column row;
    for (const Sample *s : {&last, &at_onset})
      {
        row.insert(row.end(), s->strain.begin(), s->strain.end());
        row.insert(row.end(), s->stress.begin(), s->stress.end());
        row.push_back(s->dissipated);
      }
    visitor.column("watch/samples_seen", row);
    const double *from = row.data();
    for (Sample *s : {&last, &at_onset})
      {
        std::copy_n(from, 6, s->strain.data());
        std::copy_n(from + 6, 6, s->stress.data());
        s->dissipated = from[12];
        from += 13;
      }
    base::Column of_particles(lost.begin(), lost.end()), at_that_time(lost_at_onset.begin(), lost_at_onset.end());
    visitor.column("watch/lost_strength", of_particles);
    visitor.column("watch/lost_strength_at_onset", at_that_time);
    lost.assign(of_particles.begin(), of_particles.end());
    lost_at_onset.assign(at_that_time.begin(), at_that_time.end());
  }
} // namespace dem
