#pragma once

#include "apps/scene/section.h"
#include "coupling/contact/bodies/body_contact_parameters.h"

#include <list>

namespace apps
{
  /** Sub-section of "Contacts": bodies of the solid that touch each other. */
  struct ContactSection
  {
    std::string                             name;
    std::string                             bodies; ///< names of materials, separated by commas; "": all
    coupling::bodies::BodyContactParameters law;
    double                                  energy_limit = 0.01; ///< that it may make, over the largest energy

    void declare(Section &section);
  };

  /** Section "Contacts". */
  struct ContactsSection
  {
    std::list<ContactSection> contacts;

    void declare(Section &root, std::function<bool()> is_explicit);
    /** @throws base::InputError for a name that cannot be part of a column, and contacts of what does not move */
    void check(const base::EntryPath &root, bool moves) const;
    bool empty() const { return contacts.empty(); }
  };
} // namespace apps
