#pragma once

#include "base/entry_path.h"
#include "coupling/contact/bodies/body_contact_parameters.h"

#include <list>
#include <string>

namespace apps
{
  /** Sub-section of "Contacts": bodies of the solid that touch each other. */
  struct ContactSection
  {
    std::string                             name;
    std::vector<std::string>                bodies; ///< names of materials; none: all
    coupling::bodies::BodyContactParameters law;
    double                                  energy_limit = 0.01; ///< that it may make, over the largest energy
  };

  /** Section "Contacts". */
  struct ContactsSection
  {
    std::list<ContactSection> contacts;

    /** @throws base::InputError for a name that cannot be part of a column, and contacts of what does not move */
    void check(const base::EntryPath &root, bool moves) const;
    bool empty() const { return contacts.empty(); }
  };
} // namespace apps
