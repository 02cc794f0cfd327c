#include "apps/scene/sequential/law_identification.h"

#include "apps/scene/section.h"
#include "apps/scene/sequential/particle_event.h"
#include "apps/scene/sequential/transfer_section.h"

namespace apps
{
  void declare(Section &transfer, IdentificationSection &identification, const TransferSection &law)
  {
    using Direction = IdentificationSection::Direction;
    Section &s      = transfer.section("Identification",
                                       "Test from which the mapping law is found; grips, axis and rate: Particles/Uniaxial");
    s.only_if([&law] { return law.identifies(); }, "Transfer/Mapping law/Law = identify");
    s.choice("Direction", identification.direction,
             {{"own", Direction::own}, {"tension", Direction::tension}, {"compression", Direction::compression}},
             Need::optional)
      .means("own: that of the instants; the specimen of an impact is pulled");
    s.number("Furthest strain", identification.furthest_strain, "-", Range::positive(), Need::optional)
      .means("Magnitude to which it is strained at most, in 1000 samples");
    s.number("Stop fraction", identification.stop_fraction, "-", Range::between(0.01, 0.9), Need::optional)
      .means("It ends when the stress has fallen to this part of its peak");
  }
} // namespace apps
