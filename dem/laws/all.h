#pragma once

#include "dem/laws/contact_bond.h"
#include "dem/laws/cpm.h"
#include "dem/laws/flat_joint.h"
#include "dem/laws/hertz_mindlin.h"
#include "dem/laws/linear_contact.h"
#include "dem/laws/parallel_bond.h"

#include <tuple>

namespace dem
{
  /** The link laws that a scene can name; scenes, help, link-test and generic tests go through this list. */
  using LinkLaws = std::tuple<CpmLaw, LinearContactLaw, HertzMindlinLaw, ContactBondLaw, ParallelBondLaw, FlatJointLaw>;
} // namespace dem
