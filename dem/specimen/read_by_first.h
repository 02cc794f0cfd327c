#pragma once

namespace dem
{
  class ObservedSpecimen;
  struct SpecimenCore;

  /**
   * While it lives, the first of several ranks (Specimen::share_among()) has all of a specimen and reads it alone, as one rank would; the others
   * keep what they have, and read nothing. All ranks make one, and no step is taken meanwhile. Of one process it does nothing.
   */
  class ReadByFirst
  {
  public:
    explicit ReadByFirst(const ObservedSpecimen &specimen);
    ~ReadByFirst();
    ReadByFirst(const ReadByFirst &)            = delete;
    ReadByFirst &operator=(const ReadByFirst &) = delete;

  private:
    SpecimenCore &core;
  };
} // namespace dem
