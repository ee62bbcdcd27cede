#include "app/history/calendar.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace frustum::app {
namespace {

namespace chrono = std::chrono;

bool is_digit_at(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

// So many digits from there on.
std::optional<int> digits_at(std::string_view text, std::size_t at, std::size_t count) {
  int number = 0;
  for (std::size_t k = at; k < at + count; ++k) {
    if (!is_digit_at(text, k)) return std::nullopt;
    number = 10 * number + (text[k] - '0');
  }
  return number;
}

std::optional<double> day_at(std::string_view text, std::size_t at) {
  const auto year = digits_at(text, at, 4), month = digits_at(text, at + 5, 2),
             day = digits_at(text, at + 8, 2);
  if (!year || !month || !day || text[at + 4] != '-' || text[at + 7] != '-') return std::nullopt;
  const chrono::year_month_day date{chrono::year(*year), chrono::month(unsigned(*month)),
                                    chrono::day(unsigned(*day))};
  if (!date.ok()) return std::nullopt;
  return static_cast<double>(chrono::sys_days(date).time_since_epoch().count());
}

struct TimeOfDay {
  double share = 0.0;  // of a day
  std::size_t length = 0;
};

// Hours and minutes, and seconds if they follow, with one of `between` or nothing between them.
std::optional<TimeOfDay> time_at(std::string_view text, std::size_t at, std::string_view between) {
  const auto is_between = [&](std::size_t k) {
    return k < text.size() && between.find(text[k]) != std::string_view::npos;
  };
  const auto hour = digits_at(text, at, 2);
  if (!hour || *hour > 23) return std::nullopt;
  std::size_t end = at + 2;
  const bool separated = is_between(end);
  if (separated) ++end;
  const auto minute = digits_at(text, end, 2);
  if (!minute || *minute > 59) return std::nullopt;
  end += 2;
  int seconds = 0;
  if (!separated || is_between(end)) {
    const auto second = digits_at(text, end + (separated ? 1 : 0), 2);
    if (second && *second <= 59) {
      seconds = *second;
      end += separated ? 3 : 2;
    }
  }
  return TimeOfDay{(*hour * 3600 + *minute * 60 + seconds) / 86400.0, end - at};
}

// Of "Z", "+01:00"; nothing for anything else.
std::optional<double> zone_of(std::string_view text) {
  if (text.empty() || text == "Z") return 0.0;
  if (text.size() != 6 || (text[0] != '+' && text[0] != '-') || text[3] != ':') return std::nullopt;
  const auto hours = digits_at(text, 1, 2), minutes = digits_at(text, 4, 2);
  if (!hours || !minutes || *hours > 14 || *minutes > 59) return std::nullopt;
  return (text[0] == '-' ? -1.0 : 1.0) * (*hours * 60 + *minutes) / 1440.0;
}

constexpr std::size_t kDate = 10;  // characters

bool has_form_of_day(std::string_view text, std::size_t at) {
  return digits_at(text, at, 4) && text[at + 4] == '-' && digits_at(text, at + 5, 2) &&
         text[at + 7] == '-' && digits_at(text, at + 8, 2);
}

std::size_t digits_from(std::string_view text, std::size_t at) {
  std::size_t count = 0;
  while (is_digit_at(text, at + count)) ++count;
  return count;
}

// Hours and minutes, or seconds too: "1405", "140530".
bool has_length_of_time(std::string_view text, std::size_t at) {
  const std::size_t count = digits_from(text, at);
  return count == 4 || count == 6;
}

}  // namespace

std::optional<Moment> moment_of(std::string_view text) {
  const auto day = text.size() < kDate ? std::nullopt : day_at(text, 0);
  if (!day) return std::nullopt;
  if (text.size() == kDate) return Moment{std::string(text), *day, false};
  if (text[kDate] != 'T') return std::nullopt;
  const auto time = time_at(text, kDate + 1, ":");
  if (!time) return std::nullopt;
  const auto zone = zone_of(text.substr(kDate + 1 + time->length));
  if (!zone) return std::nullopt;
  return Moment{std::string(text), *day + time->share - *zone, true};
}

MomentInName moment_in(std::string_view name) {
  MomentInName found;
  for (std::size_t at = 0; at + kDate <= name.size(); ++at) {
    const std::size_t end = at + kDate;
    if ((at > 0 && is_digit_at(name, at - 1)) || is_digit_at(name, end)) continue;
    const auto day = day_at(name, at);
    if (!day) {
      if (found.no_day.empty() && has_form_of_day(name, at)) {
        found.no_day = std::string(name.substr(at, kDate));
      }
      continue;
    }
    found.no_day.clear();
    found.moment = Moment{std::string(name.substr(at, kDate)), *day, false};
    if (end >= name.size() || (name[end] != 'T' && name[end] != '_')) return found;
    const auto time = time_at(name, end + 1, ":-.");
    if (time && !is_digit_at(name, end + 1 + time->length)) {
      found.moment =
          Moment{std::string(name.substr(at, kDate + 1 + time->length)), *day + time->share, true};
    } else if (name[end] == 'T' ? is_digit_at(name, end + 1) : has_length_of_time(name, end + 1)) {
      found.no_time = std::string(name.substr(at, end + 1 + digits_from(name, end + 1) - at));
    }
    return found;
  }
  return found;
}

std::string date_text(double day) {
  const chrono::year_month_day date{
      chrono::sys_days(chrono::days(static_cast<int>(std::floor(day))))};
  return fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()),
                     unsigned(date.day()));
}

}  // namespace frustum::app
