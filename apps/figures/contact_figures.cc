#include "apps/figures/contact_figures.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace apps
{
  namespace
  {
    /** A figure beside its known answer; 0: none. */
    nlohmann::json compared(const double value, const char *unit, const double reference)
    {
      nlohmann::json figure = {{"value", value}, {"unit", unit}};
      if (reference > 0)
        {
          figure["reference"]      = reference;
          figure["relative_error"] = value / reference - 1;
        }
      return figure;
    }
  } // namespace

  void ReferencesSection::declare(Section &root)
  {
    Section &s = root.section("References", "Known answers: summary.json then gives the relative error of each figure");
    s.number("Peak force", peak_force, "N", Range::at_least(0), Need::optional)
      .means("Largest resultant between what touches; 0: not known")
      .housekeeping();
    s.number("Contact time", contact_time, "s", Range::at_least(0), Need::optional)
      .means("From the first touch to the last; 0: not known")
      .housekeeping();
  }

  bool ContactFigures::note(const double time, const double force)
  {
    if (!touched())
      first_touch = time;
    last_touch = time;
    if (!(force > peak_force))
      return false;
    peak_force = force;
    peak_time  = time;
    return true;
  }

  std::string ContactFigures::doubt() const
  {
    constexpr double fewest = 4; // faces: over 3 an impact of balls is 40 % too long (doc/tutorials/colliding_balls.md)
    if (!touched() || !(patch > 0) || patch >= fewest * face)
      return "";
    return fmt::format(
      "where bodies touch at the largest force they do so over {:.3g} m^2, and a face of an element there has {:.3g} "
      "m^2: force, time and first touch are those of the mesh. Finer elements there (Mesh/Balls/NAME/Fineness)",
      patch, face);
  }

  void ContactFigures::put_into(nlohmann::json &figures, const ReferencesSection &known) const
  {
    figures["peak_force"]            = compared(peak_force, "N", known.peak_force);
    figures["peak_force"]["at_time"] = peak_time;
    figures["contact_time"]          = compared(contact_time(), "s", known.contact_time);
    figures["first_contact"]         = {{"value", first_touch}, {"unit", "s"}};
    if (patch > 0)
      figures["peak_force"].update({{"area_of_contact", patch}, {"face_of_element", face}, {"unit_of_areas", "m^2"}});
  }

  std::string ContactFigures::text() const
  {
    return fmt::format("contact      first at {:.6g} s, last at {:.6g} s, at most {:.6g} N\n", first_touch, last_touch,
                       peak_force);
  }

  void ContactFigures::visit_state(base::StateVisitor &visitor)
  {
    visitor.scalar("peak_force", peak_force);
    visitor.scalar("peak_time", peak_time);
    visitor.scalar("first_touch", first_touch);
    visitor.scalar("last_touch", last_touch);
    visitor.scalar("patch_at_peak", patch);
    visitor.scalar("face_at_peak", face);
  }
} // namespace apps
