#pragma once

#include "base/entry_path.h"
#include "coupling/sequential/particle_field.h"
#include "coupling/sequential/transfer_report.h"

#include <array>
#include <cstdint>
#include <string>

namespace apps
{
  /** Section "Transfer" of a sequential scene: how particle states become continuum states (doc/theory/sequential-transfer.md). */
  struct TransferSection
  {
    coupling::FieldOptions    field;
    coupling::TransferOptions options;
    std::string               law = "default"; ///< a name of coupling::mapping_laws(), "own" or "identify"
    std::string               identified_for;  ///< of an own law: see LawOrigin
    std::array<double, 3>     weights{};
    std::int64_t              fewest  = 8;
    double                    extents = 0.1; ///< see Limits/Extents

    /** Rules between entries. @throws base::InputError. */
    void check(const base::EntryPath &root) const;

    bool identifies() const; ///< the law is found by the run itself
    bool has_own() const;    ///< the scene gives the constants

    /** With the law that is named, or the scene's own constants; a law that is yet to be identified: the published one. */
    coupling::TransferOptions chosen() const;
  };
} // namespace apps
