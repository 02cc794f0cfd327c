#pragma once

#include "apps/models/mix.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/**
 * The concretes of Beygi, Kazemi, Nikbin, Vaseghi Amiri, Rabbanifar and Rahmani (2014), Cem. Concr. Res. 66, 75: two strengths with
 * largest sizes of 9.5, 12.5 and 19 mm, and what Stransky (2018, 8.3) simulated of the low one (doc/theory/mesostructure.md).
 */
namespace apps::beygi
{
  /** Modulus, strengths in tension and compression, work of fracture. */
  enum Property
  {
    modulus,
    tension,
    compression,
    fracture,
    properties
  };
  using Ratios = std::array<double, properties>;

  struct Mix
  {
    std::string           name; ///< "l-9.5"
    bool                  high   = false;
    double                cement = 0, water = 0, plasticiser = 0; ///< [kg/m^3]
    std::array<double, 3> coarse{};                               ///< of 4.75 to 9.5, to 12.5, to 19 mm [kg/m^3]
    double                unit_weight = 0;                        ///< [kg/m^3]
    double                increment   = 0;                        ///< of sizes [m], as published
    Ratios                measured{}, simulated{};                ///< over the mix of 9.5 mm; 0: not published

    /** The section of a scene with these constituents; the rest is that of another. */
    MixSection section(MixSection base) const;
    /** The mix of this strength that ratios are over. */
    const Mix &reference() const;
    double     largest() const { return coarse[2] > 0 ? 19e-3 : coarse[1] > 0 ? 12.5e-3 : 9.5e-3; } ///< size [m]
  };

  /** What a ratio may be to be that of the published simulation. */
  struct Band
  {
    double low = 0, high = 0;
    bool   holds(const double ratio) const { return ratio >= low && ratio <= high; }
  };

  constexpr double simulated_ductility = 0.1; ///< of the interface, in the simulation that is published ratio by ratio

  /** Within 0.06 of the published simulation, work of fracture within 0.25. None: of this mix or factor nothing is published, or it is the reference. */
  std::optional<Band> band_of(const Mix &mix, double ductility, Property property);

  /** Whether a ratio goes where experiment and simulation go with larger aggregates: strength in tension not up (by 0.01 at most), all others up. */
  bool right_trend(Property property, double ratio);

  /** "within" or "outside" of the band and, where that is not so, "against the trend"; "" where nothing is published. */
  std::string judgement(const Mix &mix, double ductility, Property property, double ratio);

  /** All six, the low strength first, by their largest size. */
  const std::vector<Mix> &mixes();
} // namespace apps::beygi
