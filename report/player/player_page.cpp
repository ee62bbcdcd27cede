#include "report/player/player_page.hpp"

#include <fmt/format.h>

#include <string_view>

#include "report/html/html_text.hpp"
#include "report/html/page_bundle.hpp"
#include "report/page/page_parts.hpp"
#include "report/player/path_drawing.hpp"
#include "report/player/player_data.hpp"

namespace frustum::report {
namespace {

std::string button(std::string_view attributes, std::string_view text) {
  return fmt::format("<button type=\"button\" {}>{}</button>", attributes, text);
}

struct Choice {
  std::string_view value{}, text{};
};
// With its label before it.
template <std::size_t count>
std::string choice(std::string_view name, std::string_view label, const Choice (&choices)[count]) {
  std::string html = fmt::format("<label>{} <select data-{}>", label, name);
  for (const auto& [value, text] : choices) {
    html += fmt::format("<option value=\"{}\">{}</option>", value, text);
  }
  return html + "</select></label>";
}

// Play, time and speed.
std::string transport() {
  return "<div class=\"tools transport\" role=\"group\" aria-label=\"Playing\">" +
         button("data-play aria-keyshortcuts=\"Space\"", "Play") +
         button("data-block=\"-1\" aria-label=\"Block before\" aria-keyshortcuts=\",\"",
                "&#9664;") +
         button("data-block=\"1\" aria-label=\"Next block\" aria-keyshortcuts=\".\"", "&#9654;") +
         "<input type=\"range\" class=\"scrub\" data-scrub min=\"0\" step=\"any\" value=\"0\" "
         "aria-label=\"Time in the program, s\">"
         "<output class=\"clock\" data-clock></output>"
         "<label>Speed <select data-speed></select></label></div>\n";
}

std::string display(const PlayerPage& page) {
  static constexpr Choice kColours[] = {
      {"feed", "feed, mm/min"}, {"deviation", "deviation, µm"}, {"time", "time, s"}};
  static constexpr Choice kMachine[] = {
      {"translucent", "translucent"}, {"solid", "solid"}, {"hidden", "hidden"}};
  static constexpr Choice kHold[] = {{"machine", "machine bed"}, {"workpiece", "workpiece"}};
  std::string html = "<div class=\"tools\" role=\"group\" aria-label=\"Display\">" +
                     choice("colour", "Path coloured by", kColours) +
                     "<label class=\"magnify\">Deviation × <input type=\"range\" data-magnify "
                     "min=\"0\" max=\"6\" step=\"0.05\" value=\"0\"><output "
                     "data-magnified>1</output></label>";
  if (!page.bodies.empty()) html += choice("machine", "Bodies", kMachine);
  html += choice("hold", "At rest", kHold);
  if (!page.steps.empty()) {
    html += "<label><input type=\"checkbox\" data-part checked> Workpiece</label>";
  }
  return html + "<span class=\"views\" role=\"group\" aria-label=\"View\">" +
         button("data-view=\"iso\"", "Oblique") + button("data-view=\"top\"", "Top") +
         button("data-view=\"front\"", "Front") + button("data-view=\"side\"", "Side") +
         button("data-fit=\"part\"", "Part") + button("data-fit=\"machine\"", "Machine") +
         "</span></div>\n";
}

// What is shown now; filled by the script.
std::string readings(const PlayerPage& page) {
  std::string html = "<dl class=\"readings\">";
  const auto reading = [&](std::string_view key, const std::string& name, bool wide = false) {
    html += fmt::format("<div{}><dt>{}</dt><dd data-read=\"{}\">–</dd></div>",
                        wide ? " class=\"wide\"" : "", name, key);
  };
  reading("line", "NC line", true);
  reading("tool", "Tool", true);
  reading("programmed", "Feed programmed, mm/min");
  reading("reached", "Feed of the tip, mm/min");
  reading("tip", "Tip in the workpiece frame X Y Z, mm", true);
  std::string letters;
  bool has_rotary = false;
  for (const PlayerJoint& joint : page.joints) has_rotary = has_rotary || joint.rotary;
  reading("axes", has_rotary ? "Axis positions, mm and deg" : "Axis positions, mm", true);
  reading("deviation", "Deviation of the tip X Y Z, µm", true);
  reading("size", "Size of the deviation, µm");
  return html + "</dl>\n";
}

std::string program_panel(const PlayerPage& page) {
  std::string html =
      "<div class=\"program\"><h3 id=\"program-heading\">NC program</h3>"
      "<form class=\"jump\" data-jump><label for=\"jump-line\">Line</label><input id=\"jump-line\" "
      "type=\"number\" min=\"1\" inputmode=\"numeric\" required><button type=\"submit\">Go to "
      "line</button>";
  if (page.texts.size() > 1) {
    html += "<label>File <select data-text>";
    for (std::size_t k = 0; k < page.texts.size(); ++k) {
      html += fmt::format("<option value=\"{}\">{}</option>", k, html_text(page.texts[k].name));
    }
    html += "</select></label>";
  }
  return html +
         "</form><div class=\"listing\" data-listing role=\"listbox\" tabindex=\"0\" "
         "aria-labelledby=\"program-heading\"><div class=\"rows\" role=\"presentation\"></div>"
         "</div>\n" +
         readings(page) + "</div>\n";
}

std::string player(const PlayerPage& page) {
  return "<div class=\"player\" data-player role=\"group\" aria-label=\"Player of the program\">\n"
         "<figure class=\"surface stage\"><div class=\"still\">" +
         path_drawing(page) +
         "</div><div class=\"view\" tabindex=\"0\" role=\"application\" aria-label=\"Machine, "
         "tool, "
         "path and workpiece, to be turned: arrow keys turn, plus and minus zoom\"></div>"
         "<div class=\"legend\" hidden></div>" +
         transport() + display(page) + "</figure>\n" + program_panel(page) +
         "<p class=\"unseen\" role=\"status\" data-status></p></div>\n";
}

std::string shortcuts() {
  static constexpr std::pair<std::string_view, std::string_view> kKeys[] = {
      {"Space", "Play or pause (also K)"},
      {", and .", "The block before, the next block"},
      {"Home and End", "Begin and end of the program"},
      {"[ and ]", "Slower, faster"},
      {"L", "To the field for an NC line; Enter goes there"},
      {"P", "To the NC program: arrow keys, Page Up and Page Down go through its lines"},
      {"V", "To the 3D view: arrow keys turn it, + and − zoom"},
      {"C", "Next colouring of the path"},
      {"M", "Next way to draw the bodies of the machine"},
      {"D and Shift+D", "Deviation drawn ten times larger, ten times smaller"}};
  std::string html =
      "<details class=\"keys\"><summary>Keyboard</summary><p class=\"note\">Tab goes from the view "
      "to "
      "playing, display and program. These keys work while the focus is in the player and not in a "
      "field:</p><dl class=\"shortcuts\">";
  for (const auto& [key, what] : kKeys) {
    html += fmt::format("<div><dt><kbd>{}</kbd></dt><dd>{}</dd></div>", key, what);
  }
  return html + "</dl></details>\n";
}

}  // namespace

std::string player_html(const PlayerPage& page) {
  std::string body =
      "<header><p class=\"brand\"><b>Frustum</b> Program player</p>\n<div class=\"top\"><h1>" +
      html_text(page.title) + "</h1></div><dl class=\"facts\">";
  for (const auto& [name, value] : page.facts) body += fact(html_text(name), html_text(value));
  body += "</dl></header>\n<main>" +
          section("player", "The program on the machine", player(page) + shortcuts());
  std::string notes;
  for (const std::string& note : page.notes) notes += "<li>" + html_text(note) + "</li>";
  body += section(
      "meaning", "What is shown",
      "<p class=\"note\">Deviation: " + html_text(page.deviation) +
          " Between two points of the path it is interpolated.</p>"
          "<p class=\"note\">Feed of the tip: its way in the workpiece frame over the time that it "
          "takes. Bodies of the machine are where error-free axes have them; the tool is drawn at "
          "its point of the path, with the deviation magnified. The workpiece changes at its steps "
          "and is what the path up to then has left. <span class=\"hint\">Click the path to see "
          "its "
          "NC line; drag to turn; wheel with Ctrl to zoom.</span></p>\n" +
          (notes.empty() ? std::string() : "<ul class=\"remarks\">" + notes + "</ul>\n"));
  body += page_end();
  return filled_page(html_text(page.title), body, json_in_script(player_data(page)));
}

}  // namespace frustum::report
