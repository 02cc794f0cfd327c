#include "apps/specimens/mix_work.h"

#include "apps/models/mix_materials.h"
#include "apps/results/warning.h"
#include "dem/mesostructure/bodies_apart.h"
#include "postprocess/pictures/plot.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

namespace apps
{
  MixFigures mix_figures(const MixSection &mix, const MixBox &box)
  {
    MixFigures f{
      mix.grading_curve(), mix.prescribed_content(), 0, mix.sizes_in(box.edges), mix.placed_in(box.edges, box.periodic),
      mix.smallest};
    f.reached = f.placed.structure.content();
    return f;
  }

  std::string MixFigures::text() const
  {
    return fmt::format("{} aggregates of {:.2f} to {:.2f} mm, {:.2f} % of the volume ({:.2f} % requested), {}",
                       sizes.diameters.size(), 1e3 * sizes.diameters.back(), 1e3 * sizes.diameters.front(),
                       100 * reached, 100 * requested,
                       placed.grown ? std::string("grown among each other") :
                                      fmt::format("placed at random after {} restarts", placed.restarts));
  }

  nlohmann::json MixFigures::json() const
  {
    nlohmann::json found = {{"aggregates", sizes.diameters.size()},
                            {"smallest", sizes.diameters.back()},
                            {"largest", sizes.diameters.front()},
                            {"content_requested", requested},
                            {"content", reached},
                            {"increment", sizes.increment},
                            {"curve_misfit", dem::largest_misfit(curve, smallest, sizes.diameters)},
                            {"restarts", placed.restarts},
                            {"grown", placed.grown}};
    const double   fines = curve.passing(smallest), all = dem::volume_of_spheres(sizes.diameters);
    for (const dem::SievePart &sieve : curve.points())
      {
        std::vector<double> finer;
        std::copy_if(sizes.diameters.begin(), sizes.diameters.end(), std::back_inserter(finer),
                     [&](const double d) { return d < sieve.size; });
        found["sieves"].push_back(
          {{"size", sieve.size},
           {"passing_requested", sieve.part},
           {"passing",
            sieve.size < smallest ? sieve.part : fines + (1 - fines) * dem::volume_of_spheres(finer) / all}});
      }
    return found;
  }

  std::string MixFigures::draw(const std::filesystem::path &file) const
  {
    postprocess::PlotPanel panel;
    panel.x_label = "Size [mm]";
    panel.y_label = "Passing [%]";
    panel.log_x   = true;
    panel.title   = fmt::format("{} aggregates", sizes.diameters.size());
    postprocess::PlotSeries requested_curve, there;
    requested_curve.name = "requested";
    for (const dem::SievePart &sieve : curve.points())
      {
        requested_curve.x.push_back(1e3 * sieve.size);
        requested_curve.y.push_back(100 * sieve.part);
      }
    there.name         = "aggregates";
    there.style        = postprocess::PlotSeries::Style::line;
    const double fines = curve.passing(smallest), all = dem::volume_of_spheres(sizes.diameters);
    double       finer = 0;
    for (auto d = sizes.diameters.rbegin(); d != sizes.diameters.rend(); ++d)
      {
        finer += dem::volume_of_spheres({*d});
        there.x.push_back(1e3 * *d);
        there.y.push_back(100 * (fines + (1 - fines) * finer / all));
      }
    panel.series = {requested_curve, there};
    return postprocess::plot(file, {panel});
  }

  void take_mix(dem::Packing &packing, const MixSection &mix, const MixBox &box, const double linked)
  {
    const MixFigures figures = mix_figures(mix, box);
    give_note("mix: " + figures.text());
    const std::vector<std::int32_t> of = dem::aggregates_of(figures.placed.structure, packing);
    std::vector<std::int32_t>       copy(figures.placed.structure.inclusions.size(), 0);
    if (linked > 0)
      copy = dem::numbers_apart(packing, of, copy.size(), linked);
    packing.material_names     = {mix.mortar};
    const std::int32_t highest = copy.empty() ? -1 : *std::max_element(copy.begin(), copy.end());
    for (std::int32_t k = 0; k <= highest; ++k)
      packing.material_names.push_back(aggregate_name(mix, k));
    packing.material.clear();
    for (const std::int32_t a : of)
      packing.material.push_back(a == dem::in_mortar ? 0 : 1 + copy[static_cast<std::size_t>(a)]);
  }
} // namespace apps
