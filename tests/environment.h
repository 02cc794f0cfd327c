#pragma once

#include <cstdlib>
#include <optional>
#include <string>

/** Sets an environment variable for the length of a scope. */
class Environment
{
public:
  Environment(const std::string &name_, const std::string &value)
    : name(name_)
  {
    if (const char *before = std::getenv(name.c_str()))
      previous = before;
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  ~Environment()
  {
    if (previous)
      ::setenv(name.c_str(), previous->c_str(), 1);
    else
      ::unsetenv(name.c_str());
  }
  Environment(const Environment &)            = delete;
  Environment &operator=(const Environment &) = delete;

private:
  std::string                name;
  std::optional<std::string> previous;
};
