#include "apps/drivers/sequential/transfer_section.h"

#include "apps/drivers/sequential/law_origin.h"
#include "apps/scene/nearest_name.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    constexpr const char *own_law = "own", *identified_law = "identify";

    std::vector<std::string> law_names()
    {
      std::vector<std::string> names;
      for (const auto &named : coupling::mapping_laws())
        names.push_back(named.name);
      names.emplace_back(own_law);
      names.emplace_back(identified_law);
      return names;
    }
  } // namespace

  void TransferSection::declare(Section &root)
  {
    Section &s = root.section("Transfer", "How stress and damage of the particles become the start of the continuum");
    declare_averaging(s);
    declare_law(s.section("Mapping law", "From the damage tensor to the scalar damage of the continuum"));
    declare_limits(s.section("Limits", "Doubt past which the transfer is refused"));
  }

  void TransferSection::declare_averaging(Section &s)
  {
    using coupling::Kernel;
    s.choice("Kernel", options.averaging.kernel,
             {{"nearest", Kernel::nearest},
              {"ball", Kernel::ball},
              {"gaussian", Kernel::gaussian},
              {"moving least squares", Kernel::moving_least_squares},
              {"specimen", Kernel::specimen}},
             Need::optional)
      .means("nearest: of the nearest particle; ball: mean within the width; gaussian: smooth weight within three "
             "widths; moving "
             "least squares: linear fit with that weight; specimen: mean of all particles");
    s.number("Width", options.averaging.width, "m", Range::at_least(0), Need::optional)
      .means("Of the kernel; 0: the largest of half the element, half the material's nonlocal length and three "
             "particle radii");
    s.integer("Fewest particles", fewest, "", Range::between(1, 1e6), Need::optional)
      .means("An average of fewer is counted as sparse");
    s.choice("Damage tensor", field.fit, {{"even", dem::DamageFit::even}, {"fitted", dem::DamageFit::fitted}},
             Need::optional)
      .means("even: closed form for link directions even over the sphere; fitted: least squares over the actual ones");
    s.choice(
       "Particle places", field.place,
       {{"reference", coupling::FieldOptions::Place::reference}, {"present", coupling::FieldOptions::Place::present}},
       Need::optional)
      .means(
        "reference: where the particles were at first, as the continuum's undeformed shape; present: where they are");
    s.flag("Leave out gripped particles", field.leave_out_held).means("They are no free material");
  }

  void TransferSection::declare_law(Section &l)
  {
    l.text("Law", law, Need::optional)
      .means(
        "identify: found for this scene's particles and continuum before anything is handed over; own: the constants "
        "below, e.g. those of breccia transfer --identify; default, legacy12 (the published computation), refit: of "
        "the published particles");
    const auto  own  = [this] { return has_own(); };
    const char *when = "Law = own";
    l.vector("Weights", weights, "-", {}, Need::required)
      .means("c1, c2, c3 of the sorted eigenvalues")
      .only_if(own, when);
    l.number("Factor", options.law.factor, "-", Range::positive(), Need::optional)
      .means("raw = (factor max(0, c . Omega))^exponent")
      .only_if(own, when);
    l.number("Exponent", options.law.exponent, "-", Range::positive(), Need::optional)
      .means("See Factor")
      .only_if(own, when);
    l.number("Switch damage", options.law.switch_damage, "-", Range::positive(), Need::optional)
      .means("Raw damage below it hardens instead of damaging")
      .only_if(own, when);
    l.number("Hardening start", options.law.hardening_start, "-", Range::from_up_to(0, 1), Need::optional)
      .means("kappa_P of an undamaged point")
      .only_if(own, when);
    l.number("Hardening slope", options.law.hardening_slope, "-", Range::at_least(0), Need::optional)
      .means("Growth of kappa_P with raw damage below the switch")
      .only_if(own, when);
    l.flag("Published factor", options.law.published_factor)
      .means("Take the tensor with 12/(2N) instead of 15/(2N)")
      .only_if(own, when);
    l.text("Identified for", identified_for, Need::optional)
      .means(
        "Particles and continuum that the constants belong to, as breccia transfer --identify writes it; a run with "
        "others warns")
      .only_if(own, when);
  }

  void TransferSection::declare_limits(Section &m)
  {
    coupling::TransferLimits &limits = options.limits;
    m.number("Empty", limits.empty, "-", Range::between(0, 1), Need::optional)
      .means("Share of the points: no particle within reach")
      .housekeeping();
    m.number("Sparse", limits.sparse, "-", Range::between(0, 1), Need::optional)
      .means("Share of the points: fewer particles than asked for")
      .housekeeping();
    m.number("Fully damaged", limits.fully_damaged, "-", Range::between(0, 1), Need::optional)
      .means("Share of the points: damage at or past 1")
      .housekeeping();
    m.number("Outside yield surface", limits.outside, "-", Range::between(0, 1), Need::optional)
      .means(
        "Share of the points: so far outside that more than a tenth of the stress (of the tensile strength, if that is "
        "larger) is lost")
      .housekeeping();
    m.number("Mean stress", limits.mean_stress, "-", Range::at_least(0), Need::optional)
      .means("Difference of points and particles over the larger of mean stress and tensile strength")
      .housekeeping();
    m.number("Cut forces", limits.cut_force, "-", Range::at_least(0), Need::optional)
      .means(
        "Largest difference of the force over a cut, over the larger of what is there and what the tensile strength "
        "makes")
      .housekeeping();
    m.number("Extents", extents, "-", Range::at_least(0), Need::optional)
      .means("Difference of length between particles and mesh (beyond two particle radii), and of Study/Length and "
             "Study/Area from the mesh")
      .housekeeping();
    m.number("Imbalance", limits.imbalance, "-", Range::at_least(0), Need::optional)
      .means("Unbalanced force over the forces at hand before the equilibrium iteration (not a share)")
      .housekeeping();
  }

  void TransferSection::check(const base::EntryPath &root) const
  {
    const base::EntryPath l     = root.at("Transfer").at("Mapping law");
    const auto            names = law_names();
    if (std::find(names.begin(), names.end(), law) == names.end())
      l.refuse("Law", "there is no such law. " + did_you_mean(law, names));
    if (has_own() && !identified_for.empty() && !LawOrigin::read(identified_for))
      l.refuse("Identified for", "expected the line that breccia transfer --identify writes, \"compression, particles "
                                 "0123456789abcdef, damage-plastic concrete 0123456789abcdef\".");
    chosen().law.validate();
  }

  bool TransferSection::identifies() const { return law == identified_law; }

  bool TransferSection::has_own() const { return law == own_law; }

  coupling::TransferOptions TransferSection::chosen() const
  {
    coupling::TransferOptions all = options;
    all.averaging.fewest          = static_cast<std::size_t>(fewest);
    all.law.weights               = weights;
    if (!has_own())
      all.law = {};
    for (const auto &named : coupling::mapping_laws())
      if (named.name == law)
        all.law = named.law;
    return all;
  }
} // namespace apps
