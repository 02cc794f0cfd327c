#pragma once

#include <cstddef>
#include <vector>

namespace dem
{
  /** A list whose items keep their memory when it is cleared: for what is filled anew in every step. */
  template <typename Item>
  class Recycled
  {
  public:
    void clear() { used = 0; }
    /** @return the new last item, as it was left when the list was longer. Others may move. */
    Item &add()
    {
      if (used == items.size())
        items.emplace_back();
      return items[used++];
    }

    std::size_t size() const { return used; }
    Item       &operator[](const std::size_t k) { return items[k]; }
    const Item &operator[](const std::size_t k) const { return items[k]; }
    Item       *begin() { return items.data(); }
    Item       *end() { return items.data() + used; }
    const Item *begin() const { return items.data(); }
    const Item *end() const { return items.data() + used; }

  private:
    std::vector<Item> items;
    std::size_t       used = 0;
  };
} // namespace dem
