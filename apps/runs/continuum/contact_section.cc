#include "apps/runs/continuum/contact_section.h"

namespace apps
{
  void ContactsSection::check(const base::EntryPath &root, const bool moves) const
  {
    const base::EntryPath all = root.at("Contacts");
    if (!empty() && !moves)
      all.at(contacts.front().name).refuse("goes with Model/Analysis = explicit.");
    for (const ContactSection &contact : contacts)
      if (contact.name.find_first_of(",\"") != std::string::npos)
        all.at(contact.name).refuse("a name without commas and quotes, please: it is part of columns of series.csv.");
  }
} // namespace apps
