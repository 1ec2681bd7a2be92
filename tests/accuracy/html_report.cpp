#include "tests/accuracy/html_report.h"

#include <algorithm>
#include <sstream>

#include "tests/accuracy/text_report.h"

namespace declutter::accuracy {
namespace {

std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

bool Counts(const Remark& remark) { return remark.kind != Remark::Kind::kNeutral; }

void WriteFrame(const ScoredFrame& frame, const std::vector<Remark>& remarks,
                const std::string& overlay_folder, std::ostream& out) {
  static const char* const kClasses[] = {"miss", "false", "neutral"};
  out << "<section><h2>" << Escape(frame.truth.frame) << "</h2><ul>\n";
  for (const Remark& remark : remarks) {
    const char* kind = kClasses[static_cast<size_t>(remark.kind)];
    out << "<li class=" << kind << ">" << kind << ": " << Escape(remark.text) << "</li>\n";
  }
  out << "</ul><img loading=lazy src=\"" << Escape(overlay_folder) << "/"
      << Escape(frame.truth.frame) << ".overlay.png\" alt=\"models over the image\"></section>\n";
}

}  // namespace

std::string HtmlReport(const std::vector<ScoredFrame>& frames, const Summary& summary,
                       const std::string& overlay_folder) {
  std::ostringstream out;
  out << "<!doctype html><html lang=en><meta charset=utf-8><title>Objects and truth</title>\n"
         "<style>body{font:14px sans-serif;margin:2em}section{display:inline-block;width:660px;"
         "vertical-align:top;margin:0 1em 2em 0}img{max-width:100%}.miss{color:#a40}"
         ".false{color:#b00}.neutral{color:#777}pre{background:#f4f4f4;padding:1em}</style>\n"
         "<h1>Frames with a miss or a false model</h1><pre>\n";
  std::ostringstream totals;
  WriteTotals(summary, totals);
  out << Escape(totals.str()) << "</pre>\n";
  for (const ScoredFrame& frame : frames) {
    const std::vector<Remark> remarks = RemarksOn(frame);
    if (std::any_of(remarks.begin(), remarks.end(), Counts)) {
      WriteFrame(frame, remarks, overlay_folder, out);
    }
  }
  return out.str();
}

}  // namespace declutter::accuracy
