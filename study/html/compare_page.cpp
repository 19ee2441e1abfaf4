#include "study/html/compare_page.h"

#include <span>

#include "core/files/files.h"
#include "core/text.h"
#include "study/html/html.h"

namespace chironomia::study {
namespace {

std::string figure(const char* kind, std::span<const std::byte> png, const std::string& path) {
    const std::string picture = png.empty() ? "<div class=\"none\">none</div>"
                                            : format("<img alt=\"{}\" src=\"{}\">", kind, png_source(png));
    return format("<figure class=\"{}\">{}<figcaption><b>{}</b> {}</figcaption></figure>\n", kind, picture,
                  kind, escape_html(path));
}

std::string numbers_of(const FrameComparison& frame) {
    return format(
        "<dl><div><dt>pixels that differ</dt><dd>{} of {}</dd></div>"
        "<div><dt>by too much</dt><dd>{}</dd></div>"
        "<div><dt>the most</dt><dd>{:.0f} of 255 at ({}, {})</dd></div>"
        "<div><dt>PSNR</dt><dd>{:.1f} dB</dd></div>"
        "<div><dt>mean error</dt><dd>{:.5f}</dd></div>{}</dl>\n",
        frame.pixels_above_small, frame.pixels, frame.pixels_above_large, 255 * frame.max_error, frame.max_x,
        frame.max_y, frame.psnr, frame.mean_error,
        frame.visible_differences
            ? format("<div><dt>seen by a viewer</dt><dd>{}</dd></div>", *frame.visible_differences)
            : "");
}

std::string section_of(const CompareCase& one) {
    std::string html = format("<section>\n<h2>{} <span class=\"tag\">{}</span></h2>\n", escape_html(one.name),
                              to_text(one.outcome));
    html += one.frame ? numbers_of(*one.frame) : format("<p>{}</p>\n", escape_html(one.message));
    if (one.pictures) {
        html += "<div class=\"row\">\n" + figure("expected", one.pictures->expected, one.expected.string()) +
                figure("actual", one.pictures->actual, one.actual.string()) +
                figure("difference", one.pictures->difference, one.difference.string()) + "</div>\n";
    }
    return html + "</section>\n";
}

std::string summary_of(const CompareSet& set) {
    std::string text = format("{} of {} the same", set.count(CaseOutcome::same), set.cases.size());
    for (const CaseOutcome outcome :
         {CaseOutcome::different, CaseOutcome::missing, CaseOutcome::extra, CaseOutcome::unreadable}) {
        if (const std::size_t count = set.count(outcome)) text += format(", {} {}", count, to_text(outcome));
    }
    return text;
}

}  // namespace

std::string make_compare_page(const std::string& expected, const std::string& actual, const CompareSet& set) {
    std::string sections;
    std::size_t without = 0;
    for (const CompareCase& one : set.cases) {
        if (one.outcome == CaseOutcome::same) continue;
        sections += section_of(one);
        if (one.frame && !one.pictures) ++without;
    }
    if (without > 0)
        sections +=
            format("<p class=\"note\">{} more frames differ; only the first {} show their pictures.</p>\n",
                   without, kMostPagePictures);
    std::string page = read_text(find_asset("study/web/compare.html"));
    replace_mark(page, "<!--summary-->", escape_html(summary_of(set)));
    replace_mark(page, "<!--verdict-->", set.all_same() ? "The same" : "Different");
    replace_mark(page, "<!--expected-->", escape_html(expected));
    replace_mark(page, "<!--actual-->", escape_html(actual));
    replace_mark(page, "<!--cases-->", sections);
    return page;
}

}  // namespace chironomia::study
