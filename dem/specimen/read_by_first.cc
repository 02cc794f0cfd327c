#include "dem/specimen/read_by_first.h"

#include "dem/specimen/core.h"
#include "dem/specimen/inside.h"

namespace dem
{
  ReadByFirst::ReadByFirst(const ObservedSpecimen &specimen)
    : core(core_in_parts_of(specimen))
  {
    if (core.shares())
      core.shared->let_first_read([this] { core.gather(); });
  }

  ReadByFirst::~ReadByFirst()
  {
    if (core.shares())
      core.shared->let_go(core.particles, core.bonds, core.contacts);
  }
} // namespace dem
