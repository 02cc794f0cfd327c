#include "apps/scene/sequential/transfer_section.h"

#include "apps/runs/sequential/law_origin.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    void declare_averaging(Section &s, TransferSection &transfer)
    {
      using coupling::Kernel;
      s.choice("Kernel", transfer.options.averaging.kernel,
               {{"nearest", Kernel::nearest},
                {"ball", Kernel::ball},
                {"gaussian", Kernel::gaussian},
                {"moving least squares", Kernel::moving_least_squares},
                {"specimen", Kernel::specimen}},
               Need::optional)
        .means("nearest: of the nearest particle; ball: mean within the width; gaussian: smooth weight within three "
               "widths; moving "
               "least squares: linear fit with that weight; specimen: mean of all particles");
      s.number("Width", transfer.options.averaging.width, "m", Range::at_least(0), Need::optional)
        .means("Of the kernel; 0: the largest of half the element, half the material's nonlocal length and three "
               "particle radii");
      s.integer("Fewest particles", transfer.fewest, "", Range::between(1, 1e6), Need::optional)
        .means("An average of fewer is counted as sparse");
      s.choice("Damage tensor", transfer.field.fit,
               {{"even", dem::DamageFit::even}, {"fitted", dem::DamageFit::fitted}}, Need::optional)
        .means(
          "even: closed form for link directions even over the sphere; fitted: least squares over the actual ones");
      s.choice(
         "Particle places", transfer.field.place,
         {{"reference", coupling::FieldOptions::Place::reference}, {"present", coupling::FieldOptions::Place::present}},
         Need::optional)
        .means(
          "reference: where the particles were at first, as the continuum's undeformed shape; present: where they are");
      s.flag("Leave out gripped particles", transfer.field.leave_out_held).means("They are no free material");
    }

    void declare_law(Section &l, TransferSection &transfer)
    {
      l.text("Law", transfer.law, Need::optional)
        .means(
          "identify: found for this scene's particles and continuum before anything is handed over; own: the constants "
          "below, e.g. those of breccia transfer --identify; default, legacy12 (the published computation), refit: of "
          "the published particles");
      const auto  own  = [&transfer] { return transfer.has_own(); };
      const char *when = "Law = own";
      l.vector("Weights", transfer.weights, "-", {}, Need::required)
        .means("c1, c2, c3 of the sorted eigenvalues")
        .only_if(own, when);
      l.number("Factor", transfer.options.law.factor, "-", Range::positive(), Need::optional)
        .means("raw = (factor max(0, c . Omega))^exponent")
        .only_if(own, when);
      l.number("Exponent", transfer.options.law.exponent, "-", Range::positive(), Need::optional)
        .means("See Factor")
        .only_if(own, when);
      l.number("Switch damage", transfer.options.law.switch_damage, "-", Range::positive(), Need::optional)
        .means("Raw damage below it hardens instead of damaging")
        .only_if(own, when);
      l.number("Hardening start", transfer.options.law.hardening_start, "-", Range::from_up_to(0, 1), Need::optional)
        .means("kappa_P of an undamaged point")
        .only_if(own, when);
      l.number("Hardening slope", transfer.options.law.hardening_slope, "-", Range::at_least(0), Need::optional)
        .means("Growth of kappa_P with raw damage below the switch")
        .only_if(own, when);
      l.flag("Published factor", transfer.options.law.published_factor)
        .means("Take the tensor with 12/(2N) instead of 15/(2N)")
        .only_if(own, when);
      l.text("Identified for", transfer.identified_for, Need::optional)
        .means(
          "Particles and continuum that the constants belong to, as breccia transfer --identify writes it; a run with "
          "others warns")
        .only_if(own, when);
    }

    void declare_limits(Section &m, TransferSection &transfer)
    {
      coupling::TransferLimits &limits = transfer.options.limits;
      m.number("Empty", limits.empty, "-", Range::between(0, 1), Need::optional)
        .means("Share of the points: no particle within reach")
        .housekeeping();
      m.number("Sparse", limits.sparse, "-", Range::between(0, 1), Need::optional)
        .means("Share of the points: fewer particles than required")
        .housekeeping();
      m.number("Fully damaged", limits.fully_damaged, "-", Range::between(0, 1), Need::optional)
        .means("Share of the points: damage at or past 1")
        .housekeeping();
      m.number("Outside yield surface", limits.outside, "-", Range::between(0, 1), Need::optional)
        .means("Share of the points: so far outside that more than a tenth of the stress (of the tensile strength, if "
               "that is "
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
      m.number("Extents", transfer.extents, "-", Range::at_least(0), Need::optional)
        .means("Difference of length between particles and mesh (beyond two particle radii), and of Study/Length and "
               "Study/Area from the mesh")
        .housekeeping();
      m.number("Imbalance", limits.imbalance, "-", Range::at_least(0), Need::optional)
        .means("Unbalanced force over the forces at hand before the equilibrium iteration (not a share)")
        .housekeeping();
    }
  } // namespace

  void declare(Section &root, TransferSection &transfer)
  {
    Section &s = root.section("Transfer", "How stress and damage of the particles become the start of the continuum");
    declare_averaging(s, transfer);
    declare_law(s.section("Mapping law", "From the damage tensor to the scalar damage of the continuum"), transfer);
    declare_limits(s.section("Limits", "Doubt past which the transfer is refused"), transfer);
  }
} // namespace apps
