#include "apps/models/mix.h"

#include "apps/text/nearest_name.h"
#include "apps/text/size_table.h"
#include "base/errors.h"
#include "dem/model/packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace apps
{
  dem::MixVolumes MixSection::volumes() const
  {
    dem::Mix mix;
    for (const MixConstituent &one : constituents)
      mix.constituents.push_back({one.name, one.mass, one.density});
    mix.unit_weight = unit_weight;
    mix.air         = air;
    return dem::volumes_of(mix);
  }

  namespace
  {
    /** Classes of constituents, from fine to coarse, after all that is finer. */
    dem::GradingCurve curve_of_classes(const std::list<MixConstituent> &constituents, const dem::MixVolumes &volumes)
    {
      std::vector<std::pair<const MixConstituent *, double>> classes;
      double                                                 finer = 0, all = 0;
      std::size_t                                            k = 0;
      for (const MixConstituent &one : constituents)
        {
          const double part = volumes.fractions[k++];
          if (!one.is_aggregate())
            continue;
          all += part;
          if (one.largest > 0)
            classes.emplace_back(&one, part);
          else
            finer += part;
        }
      if (classes.empty())
        throw base::InputError(
          "no constituent has sizes: give a class of aggregates its Smallest size and Largest size, or "
          "choose another Grading.");
      std::sort(classes.begin(), classes.end(),
                [](const auto &a, const auto &b) { return a.first->smallest < b.first->smallest; });
      std::vector<dem::SievePart> passing;
      for (const auto &[one, part] : classes)
        {
          if (passing.empty() || passing.back().size < one->smallest)
            passing.push_back({one->smallest, finer / all});
          else if (passing.back().size > one->smallest)
            throw base::InputError(fmt::format(
              "Constituents/{}: its sizes begin at {:g} m, within those of another class.", one->name, one->smallest));
          finer += part;
          passing.push_back({one->largest, std::min(1.0, finer / all)});
        }
      return dem::GradingCurve::of_passing(passing);
    }
  } // namespace

  dem::GradingCurve MixSection::grading_curve() const
  {
    switch (grading)
      {
      case Grading::passing:
        return grading_of(curve, false);
      case Grading::retained:
        return grading_of(curve, true);
      case Grading::file:
        return grading_in_file(curve_file);
      case Grading::fuller:
        return dem::GradingCurve::fuller(smallest, largest, fuller_exponent);
      default:
        return curve_of_classes(constituents, volumes());
      }
  }

  double MixSection::all_aggregates() const
  {
    if (constituents.empty())
      return content;
    const dem::MixVolumes of  = volumes();
    double                all = 0;
    std::size_t           k   = 0;
    for (const MixConstituent &one : constituents)
      {
        all += one.is_aggregate() ? of.fractions[k] : 0;
        ++k;
      }
    return all;
  }

  double MixSection::prescribed_content() const
  {
    const dem::GradingCurve of = grading_curve();
    return all_aggregates() * of.between(smallest, of.largest());
  }

  dem::AggregateSizes MixSection::sizes_in(const Eigen::Vector3d &box) const
  {
    const dem::GradingCurve of = grading_curve();
    if (sizes == Sizes::drawn)
      return dem::drawn_sizes(of, smallest, prescribed_content() * box.prod(), static_cast<std::uint64_t>(seed));
    return increment > 0 ? dem::sizes_by_increment(of, smallest, increment) :
                           dem::sizes_for_volume(of, smallest, prescribed_content() * box.prod());
  }

  dem::PlacedAggregates MixSection::placed_in(const Eigen::Vector3d &box, const bool periodic) const
  {
    dem::AggregatePlacement p;
    p.box           = box;
    p.periodic      = periodic;
    p.shape         = shape;
    p.shape.corners = static_cast<int>(corners);
    p.clearance     = clearance;
    p.distance      = distance;
    p.wall          = wall;
    p.tries         = tries;
    p.restarts      = static_cast<int>(restarts);
    p.seed          = static_cast<std::uint64_t>(seed);
    return dem::place_inclusions(sizes_in(box).diameters, p);
  }

  void MixSection::check_for_cell(const base::EntryPath &specimen) const
  {
    const base::EntryPath section = specimen.at("Mix");
    if (!given())
      {
        if (!constituents.empty() || content > 0)
          section.refuse("Smallest aggregate", "must be given: finer ones belong to the mortar.");
        return;
      }
    if (constituents.empty() && !(content > 0))
      section.refuse("Content", "must be above 0, or follow from Constituents.");
    if (!constituents.empty() && content > 0)
      section.refuse("Content", "follows from Constituents. Keep one of the two.");
    for (const MixConstituent &one : constituents)
      if ((one.largest > 0 || one.smallest > 0) && !(one.largest > one.smallest && one.smallest > 0))
        section.at("Constituents")
          .at(one.name)
          .refuse("Largest size", "must be above Smallest size, and this above 0.");
    if (grading == Grading::constituents && constituents.empty())
      section.refuse("Grading", "there are no Constituents: choose a curve.");
    if (grading == Grading::file && !std::filesystem::is_regular_file(curve_file))
      section.refuse("Curve file", "there is no such file.");
    if (grading == Grading::fuller && !(largest > smallest))
      section.refuse("Largest aggregate", "must be above Smallest aggregate.");
    for (const auto &[entry, name] : {std::pair{"Mortar", mortar}, std::pair{"Aggregate", aggregate}})
      if (!dem::is_material_name(name))
        section.refuse(entry, dem::material_name_rule() + std::string("."));
    if (mortar == aggregate)
      section.refuse("Aggregate", "must be another material than Mortar.");
  }

  void MixSection::require_among(const std::vector<std::string> &materials, const base::EntryPath &specimen) const
  {
    if (!given() || materials.empty())
      return;
    for (const auto &[entry, name] : {std::pair{"Mortar", mortar}, std::pair{"Aggregate", aggregate}})
      if (std::find(materials.begin(), materials.end(), name) == materials.end())
        specimen.at("Mix").refuse(entry, "is not in section Materials. " + did_you_mean(name, materials));
  }

  Eigen::Vector3d MixSection::box_behind(const Eigen::Vector3d &box) const
  {
    return {box.x(), box.y(), 2 * grading_curve().largest()};
  }

  void MixSection::check(const base::EntryPath &specimen, const Eigen::Vector3d &box, const int dimension) const
  {
    check_for_cell(specimen);
    if (!given())
      return;
    if (!(box.head(dimension).prod() > 0))
      specimen.refuse("Box size", "must be given: the aggregates of Mix lie in it.");
    try
      {
        sizes_in(dimension == 2 ? box_behind(box) : box);
      }
    catch (const base::InputError &refusal)
      {
        specimen.at("Mix").refuse_within(refusal.what());
      }
  }
} // namespace apps
