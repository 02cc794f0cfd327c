#include "dem/loading/curve_figures.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    /** Part of the peak stress up to which the slope counts as the modulus, as in EN 12390-13. */
    constexpr double elastic_part = 1.0 / 3.0;
    /** Growth of the stress from one note to the next. */
    constexpr double      growth      = 1.01;
    constexpr std::size_t note_length = 3;
  } // namespace

  bool
  is_past_peak(const UniaxialFigures &figures, const double strain, const double stress, const double stop_fraction)
  {
    return figures.strength > 0 && (stress <= std::max(fallen_part, stop_fraction) * figures.strength ||
                                    strain >= past_peak_strain * figures.strain_at_peak);
  }

  bool CurveFigures::add(const double strain, const double stress)
  {
    if (stress > 0 && (notes.empty() || stress > growth * notes[notes.size() - note_length]))
      notes.insert(notes.end(), {stress, product, square});
    area += 0.5 * (stress + last_stress) * (strain - last_strain);
    last_strain = strain;
    last_stress = stress;
    product += stress * strain;
    square += strain * strain;
    if (!(stress > strength))
      return false;
    strength       = stress;
    strain_at_peak = strain;
    return true;
  }

  UniaxialFigures CurveFigures::figures() const
  {
    UniaxialFigures found;
    found.strength       = strength;
    found.strain_at_peak = strain_at_peak;
    found.work           = area;
    found.last_stress    = last_stress;
    for (std::size_t at = 0; at < notes.size(); at += note_length)
      if (notes[at] > elastic_part * strength)
        {
          if (notes[at + 2] > 0)
            found.young_modulus = notes[at + 1] / notes[at + 2];
          break;
        }
    return found;
  }

  void CurveFigures::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("curve/strength", strength);
    visitor.scalar("curve/strain_at_peak", strain_at_peak);
    visitor.scalar("curve/product", product);
    visitor.scalar("curve/square", square);
    visitor.scalar("curve/area", area);
    visitor.scalar("curve/last_strain", last_strain);
    visitor.scalar("curve/last_stress", last_stress);
    visitor.column("curve/notes", notes);
  }
} // namespace dem
