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

  namespace
  {
    /** Part of the aggregates that is finer; below the smallest as requested. */
    double passing(const MixFigures &f, const double size)
    {
      if (size < f.smallest)
        return f.curve.passing(size);
      std::vector<double> finer;
      std::copy_if(f.sizes.diameters.begin(), f.sizes.diameters.end(), std::back_inserter(finer),
                   [&](const double d) { return d < size; });
      const double fines = f.curve.passing(f.smallest);
      return fines + (1 - fines) * dem::volume_of_spheres(finer) / dem::volume_of_spheres(f.sizes.diameters);
    }

    /** Aggregates between two neighbouring sieves: requested and placed part of the specimen [-]. */
    struct SieveClass
    {
      double from, to; ///< sizes [m]
      double requested, reached;
    };

    /** Of those that are modelled, from fine to coarse. */
    std::vector<SieveClass> classes(const MixFigures &f)
    {
      std::vector<SieveClass> found;
      const double            coarse = 1 - f.curve.passing(f.smallest);
      double                  from   = f.smallest;
      for (const dem::SievePart &sieve : f.curve.points())
        if (sieve.size > f.smallest)
          {
            found.push_back({from, sieve.size, f.requested * (sieve.part - f.curve.passing(from)) / coarse,
                             f.reached * (passing(f, sieve.size) - passing(f, from)) / coarse});
            from = sieve.size;
          }
      return found;
    }

    /** Requested and placed ones. */
    postprocess::PlotPanel curves(const MixFigures &f)
    {
      postprocess::PlotPanel panel;
      panel.x_label = "Size [mm]";
      panel.y_label = "Passing [%]";
      panel.log_x   = true;
      panel.title   = fmt::format("{} aggregates", f.sizes.diameters.size());
      postprocess::PlotSeries wanted, there, at_sieves;
      wanted.name     = "requested";
      there.name      = "placed";
      there.style     = postprocess::PlotSeries::Style::line;
      at_sieves.style = postprocess::PlotSeries::Style::points;
      there.colour = at_sieves.colour = postprocess::series_colour(1);
      at_sieves.name                  = "placed, by sieve";
      for (const dem::SievePart &sieve : f.curve.points())
        {
          wanted.x.push_back(1e3 * sieve.size);
          wanted.y.push_back(100 * sieve.part);
          at_sieves.x.push_back(1e3 * sieve.size);
          at_sieves.y.push_back(100 * passing(f, sieve.size));
        }
      const double fines = f.curve.passing(f.smallest), all = dem::volume_of_spheres(f.sizes.diameters);
      double       finer = 0;
      for (auto d = f.sizes.diameters.rbegin(); d != f.sizes.diameters.rend(); ++d)
        {
          const double before = finer; // a step at each: what passes a sieve is read off exactly
          finer += dem::volume_of_spheres({*d});
          there.x.insert(there.x.end(), 2, 1e3 * *d);
          for (const double part : {before, finer})
            there.y.push_back(100 * (fines + (1 - fines) * part / all));
        }
      panel.series = {wanted, there, at_sieves};
      return panel;
    }

    /** Of each class, likewise. */
    postprocess::PlotPanel contents(const MixFigures &f)
    {
      constexpr std::size_t  most_named = 6; // in the legend
      const auto             of         = classes(f);
      postprocess::PlotPanel panel;
      panel.x_label = "Size [mm]";
      panel.y_label = "Content of the class [% of the volume]";
      panel.log_x   = true;
      panel.title   = fmt::format("{:.2f} % requested, {:.2f} % placed", 100 * f.requested, 100 * f.reached);
      postprocess::PlotSeries wanted;
      wanted.name   = "requested";
      wanted.style  = postprocess::PlotSeries::Style::line;
      wanted.colour = "#000000";
      std::vector<postprocess::PlotSeries> there;
      for (const SieveClass &each : of)
        {
          const std::vector<double> range = {1e3 * each.from, 1e3 * each.to};
          wanted.x.insert(wanted.x.end(), range.begin(), range.end());
          wanted.y.insert(wanted.y.end(), 2, 100 * each.requested);
          postprocess::PlotSeries placed_ones;
          placed_ones.x = range;
          placed_ones.y.assign(2, 100 * each.reached);
          if (of.size() <= most_named)
            placed_ones.name = fmt::format("{:.4g} to {:.4g} mm: {:.2f} % requested, {:.2f} % placed", range[0],
                                           range[1], 100 * each.requested, 100 * each.reached);
          else
            {
              placed_ones.name   = there.empty() ? "placed" : "";
              placed_ones.colour = postprocess::series_colour(1);
            }
          there.push_back(placed_ones);
        }
      panel.series = there;
      panel.series.push_back(wanted);
      return panel;
    }
  } // namespace

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
    for (const dem::SievePart &sieve : curve.points())
      found["sieves"].push_back(
        {{"size", sieve.size}, {"passing_requested", sieve.part}, {"passing", passing(*this, sieve.size)}});
    for (const SieveClass &each : classes(*this))
      found["classes"].push_back({{"smallest", each.from},
                                  {"largest", each.to},
                                  {"content_requested", each.requested},
                                  {"content", each.reached}});
    return found;
  }

  std::string MixFigures::draw(const std::filesystem::path &file) const
  {
    return postprocess::plot(file, {curves(*this), contents(*this)});
  }

  void take_mix(dem::Packing &packing, const MixSection &mix, const MixBox &box, const double linked)
  {
    const MixFigures figures = mix_figures(mix, box);
    give_note("mix: " + figures.text());
    const std::vector<std::int32_t> of = dem::aggregates_of(figures.placed.structure, packing);
    const std::vector<std::int32_t> copy =
      dem::numbers_apart(packing, of, figures.placed.structure.inclusions.size(), linked);
    packing.material_names     = {mix.mortar};
    const std::int32_t highest = copy.empty() ? -1 : *std::max_element(copy.begin(), copy.end());
    for (std::int32_t k = 0; k <= highest; ++k)
      packing.material_names.push_back(aggregate_name(mix, k));
    packing.material.clear();
    for (const std::int32_t a : of)
      packing.material.push_back(a == dem::in_mortar ? 0 : 1 + copy[static_cast<std::size_t>(a)]);
  }
} // namespace apps
