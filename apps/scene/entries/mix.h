#pragma once

#include "apps/models/mix.h"

namespace apps
{
  class Section;

  /** Sub-section "Mix". @param specimen section */
  void declare(Section &specimen, MixSection &mix);

  /** Likewise without constants: what the mix is, and where its aggregates lie. @param places of what is of one or the other @return the sub-section */
  Section &declare_geometry(Section &section, MixSection &mix, const std::string &places);

  /** Sub-section of constants over the mortar's, as far as a law has them. @param ductility whether it has that */
  void declare_factors(Section              &mix,
                       const std::string    &name,
                       const std::string    &meaning,
                       dem::ConstantFactors &factors,
                       bool                  ductility = true);
} // namespace apps
