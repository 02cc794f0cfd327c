#include "apps/drivers/specimen_packing.h"

#include "postprocess/packing_io.h"

namespace apps
{
  dem::Packing make_packing(const SpecimenSection &specimen) { return postprocess::read_packing(specimen.file); }
} // namespace apps
