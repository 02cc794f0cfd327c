#include "apps/scene/peridynamics/loads.h"

#include "apps/scene/entries/components.h"
#include "apps/scene/entries/material_region.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/entries/region.h"
#include "apps/scene/section.h"
#include "base/errors.h"

namespace apps
{
  namespace pd = dem::peridynamics;

  namespace
  {
    /** Formulas between the commas that stand in no brackets. */
    std::vector<std::string> formulas_between_commas(const std::string &text)
    {
      std::vector<std::string> parts(1);
      int                      depth = 0;
      for (const char c : text)
        {
          depth += c == '(' ? 1 : c == ')' ? -1 : 0;
          if (c == ',' && depth == 0)
            parts.emplace_back();
          else
            parts.back() += c;
        }
      return parts;
    }
  } // namespace

  void declare(Section &section, PeridynamicTraction &peridynamic_traction)
  {
    section.text("Boundary", peridynamic_traction.boundary, Need::required)
      .means(
        "left, right (x), bottom, top (y), back, front (z), by axis x min, x max and so on, or the name of a hole");
    Entry &formulas = section.text("Value", peridynamic_traction.written, Need::optional);
    formulas.type   = "formulas";
    formulas.unit   = "Pa";
    formulas.means(
      "Components in x, y, z [m] and t between commas, \"0, 200e6\"; one alone: along the outward normal, tension "
      "positive, and "
      "of a rod along x. Where the body is brought to rest t is the load factor, and formulas without t grow with it");
    formulas.store = [&peridynamic_traction, name = section.path_of("Value")](const std::string &text,
                                                                              const Place       &from) -> std::string {
      peridynamic_traction.value.clear();
      peridynamic_traction.written = text;
      if (text.empty())
        return "";
      const std::vector<std::string> parts = formulas_between_commas(text);
      if (parts.size() > 3)
        return "expected one to three formulas between commas";
      for (const std::string &part : parts)
        {
          if (const std::string wrong = Expression::fault(part); !wrong.empty())
            return "expected formulas in x, y, z and t: " + wrong;
          peridynamic_traction.value.emplace_back(part, from.text() + ": " + name);
        }
      return "";
    };
    section.expression("Pressure", peridynamic_traction.pressure, "Pa")
      .means("Against the outward normal; empty: none");
    section
      .choice("Weight", peridynamic_traction.weight,
              {{"paper", pd::TractionWeight::paper}, {"consistent", pd::TractionWeight::consistent}}, Need::optional)
      .means("How the traction is shared out within the horizon: as published, or as the bonds that the boundary cuts "
             "off would have it");
    section
      .choice("Form", peridynamic_traction.form,
              {{"transfer", pd::TractionForm::transfer}, {"layer", pd::TractionForm::layer}}, Need::optional)
      .means("transfer: an integral over the boundary; layer: a body force in the outermost nodes, for comparison");
  }

  void declare(Section &section, PeridynamicSupport &peridynamic_support)
  {
    section.text("Boundary", peridynamic_support.boundary, Need::optional)
      .means("left, right, bottom, top, back, front, or by axis x min, x max and so on: the outermost layer of nodes; "
             "empty: "
             "the nodes of a region");
    declare(
      section, peridynamic_support.region, [&peridynamic_support] { return peridynamic_support.boundary.empty(); },
      "Boundary is empty");
    declare_components(section, "", peridynamic_support.displacement, "m",
                       "Prescribed; empty: free. Where the body is brought to rest t is the load factor, and formulas "
                       "without t grow with it");
  }

  void declare(Section &root, PeridynamicLoadsSection &peridynamic_loads)
  {
    root.section("Tractions", "One sub-section per traction on a boundary")
      .named_list("TRACTION", peridynamic_loads.tractions, &PeridynamicTraction::name);
    root
      .section("Displacements", "One sub-section per boundary or region whose motion is prescribed; of two with the "
                                "same node the later one counts")
      .named_list("SUPPORT", peridynamic_loads.supports, &PeridynamicSupport::name);
  }
} // namespace apps
