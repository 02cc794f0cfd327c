#pragma once

#include "apps/scene/section.h"
#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/transfer_report.h"

namespace apps
{
  /** Section "Transfer" of a sequential scene: how particle states become continuum states (doc/theory/sequential-transfer.md). */
  struct TransferSection
  {
    coupling::FieldOptions    field;
    coupling::TransferOptions options;
    std::string               law = "default"; ///< a name of coupling::mapping_laws(), or "own"
    std::array<double, 3>     weights{};
    std::int64_t              fewest = 8;

    void declare(Section &root);
    /** Rules between entries. @throws dem::InputError. */
    void validate(const Section &root) const;

    /** With the law that is named, or the scene's own constants. */
    coupling::TransferOptions chosen() const;
  };
} // namespace apps
