#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace python
{
  /** @throws std::out_of_range for a number beyond those there are; IndexError in Python @param what "node", "particle" */
  inline void demand_one_of(const std::string &what, const std::size_t number, const std::size_t count)
  {
    if (number >= count)
      throw std::out_of_range(what + " " + std::to_string(number) + ": there are " + std::to_string(count) +
                              ", from 0.");
  }

  /** Groups that a program has taken hold of, and whether there were as many when it kept a state. */
  class HeldGroups
  {
  public:
    /** @param group its number @param members how many hold on to it */
    void add(const std::size_t group, const std::size_t members) { groups.push_back({group, members}); }

    /** @return its members @throws std::out_of_range for a group that hold() has not made */
    std::size_t members_of(const std::size_t group) const
    {
      const auto found =
        std::find_if(groups.begin(), groups.end(), [group](const Group &one) { return one.number == group; });
      if (found == groups.end())
        throw std::out_of_range("group " + std::to_string(group) + ": hold() has made no such group.");
      return found->members;
    }

    /** A state is kept now. */
    void keep() { kept = groups.size(); }
    /** It is to be gone back to. @throws std::logic_error where groups have been made since */
    void require_kept() const
    {
      if (groups.size() != kept)
        throw std::logic_error("the saved state knows nothing of groups that are held since.");
    }

  private:
    struct Group
    {
      std::size_t number, members;
    };

    std::vector<Group> groups;
    std::size_t        kept = 0;
  };
} // namespace python
