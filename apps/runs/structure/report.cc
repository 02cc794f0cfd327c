#include "apps/runs/structure/report.h"

#include "apps/figures/drawn_curve.h"
#include "apps/figures/series_figures.h"
#include "apps/figures/summary_head.h"
#include "apps/models/tension_beyond_apex.h"
#include "apps/process/progress.h"
#include "apps/results/warning.h"
#include "apps/runs/structure/promotion_steps.h"
#include "dem/observation/crack.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  nlohmann::json StructureReport::figures() const
  {
    nlohmann::json found = nlohmann::json::object();
    for (const postprocess::SeriesColumn &column : structure.reported())
      found[column.name] = figure_of(series, column.name, column.unit, "load_factor");
    const dem::Crack crack = dem::measure_crack(structure.particle_output(), structure.link_output(), model.shape());
    found["crack"] = {{"links", crack.links}, {"cracked", crack.cracked}, {"area", quantity(crack.area, "m^2")}};
    if (model.bending_test.evaluate())
      found["bending_test"] = model.bending_test.figures(series, structure.curve().second, structure.weight().norm());
    if (model.wedge_splitting.evaluate())
      found["wedge_splitting"] = model.wedge_splitting.figures(series, structure.curve().second);
    found["load_factor"] = quantity(series.column("load_factor").back(), "-");
    return found;
  }

  nlohmann::json StructureReport::weight() const
  {
    // Where all of it is on for the first time.
    const auto &part = series.column("weight");
    const auto  row =
      static_cast<std::size_t>(std::find(part.begin(), part.end(), series.column("weight").back()) - part.begin());
    nlohmann::json found = {{"force", quantity(structure.weight().norm(), "N")},
                            {"points", row + 1},
                            {"mean_damage", series.column("mean_damage").at(row)},
                            {"weightless", structure.weightless().size()}};
    double         lost  = 0;
    for (const char *term : {"energy_damage", "energy_friction", "energy_damped"})
      lost += series.column(term).at(row);
    found["dissipated"] = quantity(lost, "J");
    return found;
  }

  LinkClasses StructureReport::classes() const
  {
    return LinkClasses(model.mixed().link_classes(structure.material_counts().names));
  }

  base::Column StructureReport::class_figures() const
  {
    return classes().figures(structure.link_output(), structure.network().network);
  }

  std::size_t StructureReport::points_by(const dem::StepControl control) const
  {
    const auto &points = structure.way().points();
    return static_cast<std::size_t>(
      std::count_if(points.begin() + 1, points.end(), [&](const auto &p) { return p.control == control; }));
  }

  nlohmann::json StructureReport::energy() const
  {
    nlohmann::json    terms  = {{"balance_error", worst_residual(series)}, {"unit", "J"}};
    const std::string prefix = "energy_";
    for (const std::string &name : series.names)
      if (name.rfind(prefix, 0) == 0)
        terms[name.substr(prefix.size())] = series.column(name).back();
    return terms;
  }

  nlohmann::json StructureReport::cost() const
  {
    std::int64_t solutions = 0;
    for (const dem::QuasiStaticPoint &p : structure.way().points())
      solutions += p.iterations;
    nlohmann::json found = {{"particles", structure.network().network.particles()},
                            {"links", structure.network().network.links.size()},
                            {"solutions", solutions},
                            {"threads", omp_get_max_threads()},
                            {"wall_seconds", wall_seconds}};
    if (const StructureSolid *solid = structure.surrounding())
      found.update({{"elements", solid->elements()}, {"unknowns", solid->unknowns()}, {"joints", solid->joints()}});
    return found;
  }

  nlohmann::json StructureReport::summary() const
  {
    nlohmann::json summary = summary_head(request, "structure");
    summary["figures"]     = figures();
    summary["points"]      = {{"strain", points_by(dem::StepControl::strain)},
                              {"opening", points_by(dem::StepControl::opening)},
                              {"leading", points_by(dem::StepControl::leading)},
                              {"relaxed", points_by(dem::StepControl::relaxed)},
                              {"promotion", points_by(dem::StepControl::changed)}};
    summary["warnings"]    = tension_beyond_apex(model.material);
    if (model.gravity.acts())
      summary["weight"] = weight();
    summary["energy"] = energy();
    summary["cost"]   = cost();
    structure.material_counts().put_into(summary);
    model.mixed().put_into(summary);
    if (const nlohmann::json by_class = classes().json(class_figures()); !by_class.empty())
      summary["link_classes"] = by_class;
    if (!media.empty() && structure.surrounding())
      summary["medium"] = {{"difference_of_stiffness", quantity(structure.surrounding()->difference_from(media), "-")}};
    auto handshake = model.handshakes.handshakes.begin();
    for (const auto &[all, damaged] : structure.shared_bonds())
      summary["handshakes"][(handshake++)->name] = {{"bonds", all}, {"damaged", damaged}};
    handshake = model.handshakes.handshakes.begin();
    for (const std::size_t elements : structure.promoted())
      summary["handshakes"][(handshake++)->name]["promoted"] = elements;
    if (const auto step = largest_promotion_step(series, structure.way().points()))
      summary["promotion"] = {{"largest_change_of_force", quantity(step->change, "-")},
                              {"load_factor", quantity(step->load_factor, "-")}};
    return summary;
  }

  std::string StructureReport::text() const
  {
    std::string text = model.mixed().text();
    for (const postprocess::SeriesColumn &column : structure.reported())
      {
        const auto &values = series.column(column.name);
        text += fmt::format("{:<40} {:.6g} {} at its peak, {:.6g} at the end\n", column.name, values[peak_row(values)],
                            column.unit, values.back());
      }
    if (model.gravity.acts())
      {
        const nlohmann::json on = weight();
        text += fmt::format("weight       {:.6g} N, put on in {} points; {:.3g} J of it dissipated\n",
                            on["force"]["value"].get<double>(), on["points"].get<std::size_t>(),
                            on["dissipated"]["value"].get<double>());
      }
    const dem::Crack crack = dem::measure_crack(structure.particle_output(), structure.link_output(), model.shape());
    text += fmt::format("crack        {} of {} links cracked, {:.4g} m^2\n", crack.cracked, crack.links, crack.area);
    if (!media.empty() && structure.surrounding())
      text += fmt::format("medium       stiffness of the solid differs by {:.2g} from that of the particles\n",
                          structure.surrounding()->difference_from(media));
    text += classes().text(class_figures());
    auto handshake = model.handshakes.handshakes.begin();
    for (const auto &[all, damaged] : structure.shared_bonds())
      text +=
        fmt::format("handshake    {}: {} of {} bonds in the overlap damaged\n", (handshake++)->name, damaged, all);
    handshake = model.handshakes.handshakes.begin();
    for (const std::size_t elements : structure.promoted())
      text += fmt::format("promotion    {}: {} elements have become particles\n", (handshake++)->name, elements);
    if (const auto step = largest_promotion_step(series, structure.way().points()))
      text +=
        fmt::format("             the force changes by {:+.2g} % at most where they do, at the load factor {:.6g}\n",
                    100 * step->change, step->load_factor);
    if (model.bending_test.evaluate())
      text += model.bending_test.text(series, structure.curve().second, structure.weight().norm());
    if (model.wedge_splitting.evaluate())
      text += model.wedge_splitting.text(series, structure.curve().second);
    const std::string led = model.path.leading.empty() ?
                              "" :
                              fmt::format("{} led by {}, ", points_by(dem::StepControl::leading), model.path.leading);
    text += fmt::format(
      "path         {}{} points controlled by the load factor, {} by opening, {} relaxed (cascades)\n", led,
      points_by(dem::StepControl::strain), points_by(dem::StepControl::opening), points_by(dem::StepControl::relaxed));
    text += warning_lines(tension_beyond_apex(model.material));
    text += fmt::format("energy       balance error {:.1e} at worst\n", worst_residual(series));
    text += fmt::format("cost         {} with {} threads\n", duration_text(wall_seconds), omp_get_max_threads());
    return text;
  }
} // namespace apps
