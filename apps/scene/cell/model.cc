#include "apps/scene/cell/model.h"

#include "apps/scene/entries/material.h"
#include "apps/scene/entries/mix.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/physics.h"
#include "apps/scene/entries/specimen.h"
#include "apps/scene/entries/time.h"
#include "apps/scene/section.h"
#include "apps/scene/usual_sizes.h"
#include "base/voigt.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    /** "stress -1" is taken for one in MPa until its unit is named. */
    Entry &question_stress(Entry &target)
    {
      target.store = [store = target.store](const std::string &text, const Place &from) -> std::string {
        const std::string kind = "stress ";
        if (text.compare(0, kind.size(), kind) != 0)
          return store(text, from);
        const std::string value = text.substr(kind.size()), question = question_about_list("stress", "Pa", value);
        return question.empty() ? store(kind + list_without_units(value, "Pa"), from) : question;
      };
      return target;
    }

    void declare_loading(Section &root, CellModel &model)
    {
      Section &section = root.section("Loading", "The path along which the cell is driven, leg by leg");
      section.integer("Legs", model.legs, "", Range::between(1, CellModel::most_legs), Need::optional)
        .means("Legs of the path");
      section.number("Servo time", model.servo_time, "-", Range::positive(), Need::optional)
        .means("Time constant with which stresses are reached, over the time of a pressure wave across the cell");
      section.number("Strain limit", model.strain_limit, "-", Range::positive(), Need::optional)
        .means("Largest strain that may be used to reach a stress; beyond, the cell cannot carry it and the path ends");
      section.number("Localised above", model.localised_above, "-", Range::between(0.01, 0.99), Need::optional)
        .means("Concentration of the strength lost since softening began at which the cell counts as localised; 0.5: a "
               "band of 60 % of it");
      for (int i = 0; i < CellModel::most_legs; ++i)
        {
          Section &leg =
            section.section(fmt::format("Leg {}", i + 1), "Targets at its end; they are approached evenly in time");
          leg.only_if([&model, i] { return i < model.legs; }, fmt::format("Loading/Legs is at least {}", i + 1));
          leg.number("Duration", model.path[i].duration, "s", Range::positive(), Need::required).means("Of the leg");
          for (int c = 0; c < 6; ++c)
            question_stress(leg.text(base::voigt_names[c], model.path[i].target[c], Need::optional))
              .means(c < 3 ? "\"strain VALUE\" [-] or \"stress VALUE\" [Pa], tension positive" :
                             "\"strain VALUE\" (engineering shear) [-] or \"stress VALUE\" [Pa]");
        }
    }
  } // namespace

  void declare(Section &root, CellModel &model)
  {
    SpecimenSection::Use use;
    use.box  = false;
    use.cell = true;
    declare(root, model.source, model.physics.dimension, use);
    declare(*root.find_section("Specimen"), model.mix);
    declare(root, model.material);
    declare_physics(root, model.physics);
    declare(root, model.time);
    declare_loading(root, model);
    declare_for_ranks(root, model.output);
  }
} // namespace apps
