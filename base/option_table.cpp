// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/option_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ridgecraft {

namespace {

struct OptionGroup {
  std::string_view title;
  std::vector<Option> options;
};

std::vector<OptionGroup> option_groups() {
  using Kind = OptionKind;
  constexpr double smallest_model_mm = 1.0;
  constexpr double largest_model_mm = 100'000.0;
  constexpr Label of_preset{"the preset's", "wie voreingestellt"};
  // It would put each member on a line of its own.
  // clang-format off
  return {
    {"Input", {
      {.name = "only", .kind = Kind::list, .takes = "NAME",
       .help = "Take nothing but objects and materials of this name; 'wheel*' takes all whose names begin "
       "so. May be given several times; info lists the names.",
       .setting = "only", .studio = {"pieces", {"Only objects named", "Nur Objekte namens"}}},
      {.name = "without", .kind = Kind::list, .takes = "NAME",
       .help = "Leave them out, in the same way.",
       .setting = "without", .studio = {"pieces", {"Without objects named", "Ohne Objekte namens"}}},
    }},
    {"Output", {
      {.name = "output", .letter = "o", .kind = Kind::list, .takes = "WHERE",
       .help = "A folder gets all default formats (PDF, SVG, FOLD, HTML); a file's suffix names its format "
       "(.pdf, .svg, .fold, .html, .ridgecraft, .png, .dxf, .lbrn2, .eps, .plt). May be given several times "
       "(the current folder)."},
      {.name = "no-guide", .kind = Kind::flag,
       .help = "Write no NAME-guide.pdf next to NAME.pdf: pictures of where each piece goes, step by step."},
      {.name = "no-page", .kind = Kind::flag,
       .help = "Write no NAME.html: the model and its sheets side by side in any browser, folding and step "
       "by step."},
      {.name = "overwrite", .kind = Kind::flag,
       .help = "Replace existing files, also those that weren't made from this model."},
    }},
    {"Size", {
      {.name = "size", .kind = Kind::length, .low = smallest_model_mm, .high = largest_model_mm,
       .help = "Largest extent of the finished model: 150mm, 20cm, 8in; a number alone means mm (150mm, or "
       "what its folds and pages need between 100mm and 400mm).",
       .setting = "size_mm", .keyword = "size",
       .studio = {"size", {"Largest side", "Längste Seite"}, {"as needed", "nach Bedarf"}, {}, false}},
      {.name = "height", .kind = Kind::length, .low = smallest_model_mm, .high = largest_model_mm,
       .help = "Instead of --size: from the foot of the finished model to its top, as its guide shows it.",
       .keyword = "height",
       .studio = {"size", {"Height, instead of the largest side", "Höhe statt der längsten Seite"},
           {"as needed", "nach Bedarf"}}},
      {.name = "width", .kind = Kind::length, .low = smallest_model_mm, .high = largest_model_mm,
       .help = "The same from its left to its right.",
       .keyword = "width",
       .studio = {"size", {"Width, instead", "Breite statt dessen"}, {"as needed", "nach Bedarf"}}},
      {.name = "depth", .kind = Kind::length, .low = smallest_model_mm, .high = largest_model_mm,
       .help = "The same from its back to its front.",
       .keyword = "depth",
       .studio = {"size", {"Depth, instead", "Tiefe statt dessen"}, {"as needed", "nach Bedarf"}}},
      {.name = "up", .kind = Kind::choice,
       .choices = {{"x"}, {"y"}, {"z"}},
       .help = "The axis of the file that points up, where the guide has the model lie (as the file says, or "
       "else as it stands best).",
       .setting = "up", .keyword = "up",
       .studio = {"size", {"Axis that points up", "Achse, die nach oben zeigt"},
           {"as it stands best", "wie es am besten steht"}}},
      {.name = "scale", .takes = "FACTOR",
       .help = "Instead of --size: 1:50, 0.5 or 30% of the size that the file's numbers give in --unit.",
       .keyword = "scale",
       .studio = {"size", {"Scale", "Maßstab"}, {},
           {"instead of a size: 1:50 or 30%", "statt einer Größe: 1:50 oder 30%"}}},
      {.name = "unit", .takes = "UNIT",
       .choices = {{"mm"}, {"cm"}, {"m"}, {"in"}, {"ft"}},
       .help = "Unit of the file's numbers: mm, cm, m, in, ft (what the file says, else mm); used with "
       "--scale.",
       .keyword = "unit",
       .studio = {"size", {"The file is in", "Die Datei ist in"}, {"as it says", "wie sie sagt"}}},
      {.name = "faces", .kind = Kind::whole, .takes = "N|auto|keep", .usual = "auto", .low = 4.0,
       .choices = {{"auto"}, {"keep"}},
       .help = "How many faces to keep: auto simplifies a model whose edges would be too short to fold, keep "
       "never does, a number simplifies to that many (auto).",
       .setting = "faces", .noted = Noted::always, .keyword = "simplify",
       .studio = {"size", {"Faces", "Flächen"}, {},
           {"auto, keep, or a number", "auto, keep oder eine Zahl"}, false}},
      {.name = "hours", .kind = Kind::number, .usual = "4", .low = 0.25, .high = 1000.0,
       .help = "How long building it may take: with --faces auto a model that takes longer, or has too many short "
       "edges, is simplified; by default one with long edges is left as it is up to 10 hours (4).",
       .setting = "hours", .noted = Noted::if_changed, .keyword = "hours",
       .studio = {"size", {"Hours of work", "Stunden Arbeit"}, {}, {}, false}},
      {.name = "strict", .kind = Kind::flag,
       .help = "Write nothing, with exit code 9, where the model can't be folded by hand at this size.",
       .keyword = "strict"},
    }},
    {"Paper", {
      {.name = "paper", .takes = "NAME|WxH", .usual = "A4",
       .choices = {{"A4"}, {"A3"}, {"A2"}, {"A5"}, {"letter"}, {"legal"}, {"tabloid"},
                   {"A4-landscape", {"A4 across", "A4 quer"}}, {"A3-landscape", {"A3 across", "A3 quer"}},
                   {"letter-landscape", {"letter across", "Letter quer"}}},
       .help = "A0 to A7, B0 to B6, letter, legal, tabloid and others, -landscape added to turn it, or a "
       "size such as 300x200mm (A4).",
       .keyword = "sheet", .studio = {"paper", {"Sheet", "Bogen"}, {}, {}, false}},
      {.name = "margin", .kind = Kind::length, .usual = "10mm", .high = 1e6,
       .help = "What the printer can't reach, on all four sides (10mm).",
       .setting = "margin_mm", .noted = Noted::with_pages, .keyword = "margin",
       .studio = {"paper", {"Margin", "Rand"}}},
      {.name = "calibrate", .takes = "WxH",
       .help = "What comes out where 100 mm were printed, across the sheet and up it, such as 100.4x99.6: "
       "twice the length of the bar of 50 mm. Pages are drawn so that the next ones have the right size.",
       .studio = {"paper", {"Printed 100 mm come out as", "Gedruckte 100 mm werden zu"}, {},
           {"across and up the sheet: 100.4x99.6", "quer und längs des Bogens: 100.4x99.6"}}},
      {.name = "most-pages", .kind = Kind::whole, .takes = "N", .usual = "300", .low = 1.0,
       .help = "A model that would take more pages is refused before the long work, with a size that takes "
       "few (300).",
       .studio = {"paper", {"Pages at most", "Seiten höchstens"}}},
      {.name = "page-by", .kind = Kind::choice, .takes = "material|object", .usual = "any",
       .choices = {{"any", {"any kind", "jeder Art"}}, {"material", {"one material", "eines Materials"}},
                   {"object", {"one object", "eines Objekts"}}},
       .help = "Only pieces of one material, or of one object, on a page, for paper in several colours: cuts "
       "run along the borders between them (any).",
       .setting = "page_by", .studio = {"paper", {"A page holds pieces of", "Eine Seite enthält Teile"}}},
      {.name = "pack", .kind = Kind::choice, .usual = "fast",
       .choices = {{"fast", {"a moment", "einen Augenblick"}}, {"good", {"longer", "länger"}}, {"best", {}, "good"}},
       .help = "How long a search for fewer sheets takes: hundredths of a second, or tenths (fast).",
       .setting = "pack", .keyword = "pack",
       .studio = {"paper", {"To save sheets, search for", "Um Bögen zu sparen, suche"}}},
      {.name = "grain", .kind = Kind::choice, .usual = "any",
       .choices = {{"any", {"any direction", "beliebig"}},
                   {"long", {"along the long side", "längs der langen Seite"}},
                   {"short", {"along the short side", "längs der kurzen Seite"}}},
       .help = "Lay pieces so that most of their folds run along the sheet's long or short side, as the "
       "paper's grain does: folds across it crack. Takes more sheets at times (any).",
       .setting = "grain", .keyword = "grain",
       .studio = {"paper", {"Grain of the paper", "Laufrichtung des Papiers"}}},
    }},
    {"Tabs and lines", {
      {.name = "tabs", .kind = Kind::choice, .usual = "auto",
       .choices = {{"auto", {"where there is more room", "wo mehr Platz ist"}},
                   {"one-side", {"all of a seam at one piece", "je Naht an einem Teil"}},
                   {"alternate", {"one piece and the other in turn", "abwechselnd an beiden Teilen"}},
                   {"both", {"on both sides", "auf beiden Seiten"}},
                   {"slots", {"arrows into slits, without glue", "Pfeile in Schlitze, ohne Kleber"}},
                   {"none", {"none", "keine"}}},
       .help = "Which side of a cut gets the glue tab: that with more room behind it; along a seam of two "
       "pieces always the same piece, or one after the other, as far as there is room; both, to be glued to "
       "each other; arrows that go into slits of the neighbour, without glue, where there is room for them; "
       "neither (auto).",
       .setting = "tab_sides", .keyword = "tabs",
       .studio = {"tabs", {"Glue tabs", "Klebelaschen"}, {}, {}, false}},
      {.name = "tab-height", .kind = Kind::length, .usual = "5mm", .low = 1.5, .high = 50.0,
       .help = "Height of the glue tabs (5mm); also by length of edge: 4mm,20mm:5mm,60mm:8mm is 4 mm, from "
       "20 mm on 5, from 60 mm on 8.",
       .setting = "tab_height_mm", .noted = Noted::always, .keyword = "tab_height",
       .studio = {"tabs", {"Height of tabs", "Höhe der Laschen"}, {}, {}, false}},
      {.name = "tab-angle", .kind = Kind::angle, .usual = "45", .low = 15.0, .high = 90.0,
       .help = "Side angle of the glue tabs, 90 for rectangles; steeper where an edge is short (45). By "
       "length of edge in the same way: 60,20mm:45.",
       .setting = "tab_angle_deg", .noted = Noted::always, .keyword = "tab_angle",
       .studio = {"tabs", {"Angle of tabs", "Winkel der Laschen"}}},
      {.name = "border-tabs", .kind = Kind::flag,
       .help = "Tabs also at borders of open models, which are glued to nothing of the model.",
       .setting = "border_tabs", .keyword = "border_tabs",
       .studio = {"tabs", {"Tabs at open borders, too", "Laschen auch an offenen Rändern"}}},
      {.name = "tab-file", .kind = Kind::file,
       .help = "Tabs edge by edge: a number of an edge a line, then none, both, height=7mm, angle=60 or the "
       "name of the piece that gives the tab.",
       .setting = "tab_file"},
      {.name = "tab-shadow", .kind = Kind::flag,
       .help = "Thin lines on the faces behind which tabs come to lie.",
       .keyword = "tab_shadow",
       .studio = {"tabs", {"Show where tabs come to lie", "Zeigen, wo Laschen hinkommen"}}},
      {.name = "all-tabs", .kind = Kind::flag,
       .help = "Split pieces further until every edge with a face wide enough behind it has a glue tab.",
       .setting = "all_tabs", .keyword = "all_tabs",
       .studio = {"tabs", {"A tab at every seam, with more pieces", "Jede Naht mit Lasche, mehr Teile"}}},
      {.name = "no-tabs", .kind = Kind::flag,
       .help = "Draw no glue tabs: the same as --tabs none.", .same_as = "tabs=none"},
      {.name = "hide-folds", .kind = Kind::angle, .usual = "3", .high = 180.0,
       .help = "Draw no line where the surface is folded by less than this (3).",
       .setting = "hide_folds_deg", .noted = Noted::with_pages, .keyword = "hide_folds",
       .studio = {"tabs", {"No line where folded by less than", "Keine Linie bei Falzen unter"}}},
      {.name = "numbers", .kind = Kind::choice, .usual = "inside",
       .choices = {{"inside", {"on the pieces", "auf den Teilen"}},
                   {"tabs", {"on the tabs", "auf den Laschen"}},
                   {"outside", {"next to the pieces", "neben den Teilen"}},
                   {"back", {"on the back of the sheet", "auf der Rückseite des Bogens"}}},
       .help = "Where the numbers of edges stand: on the pieces and their tabs; on tabs, and next to the "
       "piece at edges without one; next to the pieces; on the back of the paper, which the PDF gets pages "
       "for (inside).",
       .keyword = "numbers",
       .studio = {"tabs", {"Numbers of the edges", "Nummern der Kanten"}, {}, {}, false}},
      {.name = "duplex", .kind = Kind::choice, .usual = "long",
       .choices = {{"long", {"over the long edge", "über die lange Kante"}},
                   {"short", {"over the short edge", "über die kurze Kante"}}},
       .help = "With --numbers back: over which edge the printer turns the sheets (long).",
       .keyword = "duplex", .studio = {"tabs", {"The printer turns sheets", "Der Drucker wendet Bögen"}}},
    }},
    {"Colours", {
      {.name = "ink", .kind = Kind::choice, .usual = "colour",
       .choices = {{"colour", {"of the model", "des Modells"}}, {"pale", {"pale", "blass"}},
                   {"lines", {"none, lines alone", "keine, nur Linien"}}},
       .help = "Print the model's colours and pictures, print them as light tints, or print lines alone "
       "(colour; lines with a machine's preset).",
       .keyword = "ink", .studio = {"paper", {"Colours", "Farben"}, {}, {}, false}},
      {.name = "details", .kind = Kind::choice, .usual = "auto",
       .choices = {{"auto", {"where there are no pictures", "wo es keine Bilder gibt"}},
                   {"lines", {"as lines", "als Linien"}},
                   {"shade", {"as shade", "als Schatten"}}, {"none", {"not", "nicht"}}},
       .help = "Print what simplification takes from the model's shape: edges that the paper has no fold for, as "
       "thin grey lines; its hollows, as shade; or nothing; auto draws lines on models without pictures (auto).",
       .keyword = "details",
       .studio = {"paper", {"Details lost to simplification", "Beim Vereinfachen verlorene Details"}}},
      {.name = "dpi", .kind = Kind::number, .takes = "DOTS", .usual = "300", .low = 36.0, .high = 1200.0,
       .help = "Dots an inch of printed pictures (300).",
       .keyword = "dpi", .studio = {"paper", {"Dots an inch of pictures", "Bildpunkte je Zoll"}}},
    }},
    {"Parts", {
      {.name = "keep-bodies", .kind = Kind::flag,
       .help = "Leave bodies that touch or run into each other as they are, hidden faces and all; without it "
       "they become one outer skin.",
       .keyword = "keep_bodies",
       .studio = {"pieces", {"Keep bodies that run into each other", "Körper, die ineinander stecken, lassen"}}},
      {.name = "skins", .kind = Kind::choice, .usual = "outer",
       .choices = {{"outer", {"their outer skin", "ihre Außenhaut"}},
                   {"middle", {"a sheet in the middle", "ein Bogen in der Mitte"}},
                   {"both", {"inside and outside", "innen und außen"}}},
       .help = "Walls thinner than 3 mm become a sheet: their outer skin, or one in the middle of the wall; "
       "both leaves inside and outside (outer).",
       .setting = "skins", .keyword = "skins",
       .studio = {"pieces", {"Thin walls become", "Dünne Wände werden"}}},
      {.name = "concavity", .kind = Kind::number, .takes = "TOLERANCE", .usual = "0.1", .low = 0.001,
       .high = 2.0,
       .help = "How far a part may be from convex, as a share of the radius of the model's bounding sphere "
       "(0.1).",
       .setting = "concavity", .noted = Noted::always, .keyword = "concavity",
       .studio = {"pieces", {"Hollows that a part may have", "Höhlungen, die ein Körperteil haben darf"}}},
    }},
    {"Machines", {
      {.name = "preset", .kind = Kind::choice, .usual = "print",
       .choices = {{"print", {"a printer", "einen Drucker"}}, {"lightburn", {"LightBurn", "LightBurn"}},
                   {"laser", {"a laser", "einen Laser"}}, {"glowforge", {"Glowforge", "Glowforge"}},
                   {"cricut", {"Cricut", "Cricut"}}, {"silhouette", {"Silhouette", "Silhouette"}},
                   {"scanncut", {"ScanNCut", "ScanNCut"}}, {"plotter", {"a plotter", "einen Plotter"}},
                   {"packaging", {"a packaging shop", "eine Verpackungsfirma"}},
                   {"origami-simulator", {"Origami Simulator", "Origami Simulator"}}},
       .help = "Files as a machine or its program expects them, named after it: pieces alone, lines by "
       "operation (formats --presets shows them; print).",
       .studio = {"machine", {"Files for", "Dateien für"}}},
      {.name = "dxf", .kind = Kind::choice,
       .choices = {{"r2000"}, {"r12"}, {"plain"}},
       .help = "Which DXF: r2000 states the unit; r12 is for older machines; plain is single lines on one "
       "layer (r2000).",
       .studio = {"machine", {"Kind of DXF", "Art des DXF"}, {"usual", "übliche"}}},
      {.name = "kerf", .kind = Kind::length, .high = 2.0,
       .help = "Width of the cut: outlines are moved outwards by half of it, holes inwards, so that pieces "
       "come out as large as drawn (laser, glowforge: 0.1mm; others: 0).",
       .studio = {"machine", {"Width of the cut", "Breite des Schnitts"},
           {"the machine's", "die der Maschine"}}},
      {.name = "kerf-test", .kind = Kind::flag,
       .help = "Add a square of 20 mm with a hole of 10 mm, by which the kerf is measured.",
       .studio = {"machine", {"Add a square to measure the kerf", "Ein Quadrat dazu, das den Schnitt misst"}}},
      {.name = "score", .kind = Kind::choice,
       .choices = {{"solid", {"the whole line", "die ganze Linie"}},
                   {"dashes", {"dashes cut through", "Striche, durchgeschnitten"}},
                   {"perforate", {"a perforation", "eine Perforation"}},
                   {"ends", {"lines next to the piece", "Linien neben dem Teil"}},
                   {"none", {"nothing", "nichts"}}},
       .help = "What is done at folds: the whole line, dashes of 2 mm cut through, a perforation, lines of 4 "
       "mm next to the piece at their ends, or nothing (the preset's).",
       .studio = {"machine", {"At folds", "An Falzen"}, of_preset}},
      {.name = "bridges", .kind = Kind::whole, .takes = "N", .usual = "0", .high = 50.0,
       .help = "Leave each outline uncut at N places, so that pieces stay in the sheet (0).",
       .studio = {"machine", {"Places left uncut", "Stellen ohne Schnitt"}}},
      {.name = "thickness", .kind = Kind::length, .usual = "0", .high = 20.0,
       .help = "Of the sheet: pieces become smaller or larger at their folds and seams, so that the model's "
       "outside is as large as asked when it is built of board; there is no NAME.html then (0).",
       .setting = "thickness_mm", .studio = {"machine", {"Thickness of the sheet", "Dicke des Bogens"}}},
      {.name = "hinge", .kind = Kind::choice,
       .choices = {{"back", {"at its back", "hinten"}}, {"middle", {"in the middle", "in der Mitte"}},
                   {"front", {"in front", "vorn"}}},
       .help = "Where a fold of board turns: at its back where it is scored from the printed side, in the "
       "middle where it is creased or perforated, in front where it is grooved from behind (back where folds "
       "are whole lines, middle where they are dashes).",
       .setting = "hinge",
       .studio = {"machine", {"A fold of board turns", "Ein Falz aus Pappe dreht sich"}, of_preset}},
      {.name = "bed", .takes = "WxH",
       .help = "The machine's work area, used to its edges (the preset's).",
       .studio = {"machine", {"Work area", "Arbeitsfläche"}, of_preset,
           {"such as 400x300mm", "etwa 400x300mm"}}},
      {.name = "engrave", .kind = Kind::choice,
       .choices = {{"on", {"written on the pieces", "auf den Teilen"}}, {"off", {"left out", "weglassen"}}},
       .help = "Whether numbers and names are written on the pieces (the preset's).",
       .studio = {"machine", {"Numbers and names", "Nummern und Namen"}, of_preset}},
      {.name = "colour", .kind = Kind::list, .takes = "OPERATION=#RRGGBB",
       .help = "Colour of an operation's lines: marks, numbers, mountain, valley, tab, inner or cut. May be "
       "given for several (the preset's).",
       .studio = {"machine", {"Colours of operations", "Farben der Arbeitsschritte"}, of_preset,
           {"such as cut=#ff0000; tab=#0000ff", "etwa cut=#ff0000; tab=#0000ff"}}},
      {.name = "spot", .kind = Kind::list, .takes = "STEP=NAME",
       .help = "Name of the ink of a step in a packaging shop's PDF: cut=CutContour, "
       "perforate=PerfCutContour, crease=Crease, glue=Glue. May be given for several.",
       .studio = {"machine", {"Inks of a packaging shop", "Farbnamen der Verpackungsfirma"}, {},
           {"such as cut=Die; crease=Fold", "etwa cut=Die; crease=Fold"}}},
      {.name = "print-and-cut", .kind = Kind::flag,
       .help = "Two files for each sheet, in one place: a PDF with colours, numbers and registration marks, "
       "and what is cut.",
       .studio = {"machine", {"Print, then cut", "Drucken, dann schneiden"}}},
      {.name = "hairline", .kind = Kind::flag,
       .help = "Lines 0.01 mm wide, for drivers that cut nothing wider.",
       .studio = {"machine", {"Hairlines", "Haarlinien"}}},
      {.name = "svg-px", .kind = Kind::choice,
       .choices = {{"96"}, {"72"}},
       .help = "SVG in pixels, so many an inch, for programs that pass over millimetres.",
       .studio = {"machine", {"Pixels an inch of SVG", "Pixel je Zoll im SVG"},
           {"millimetres", "Millimeter"}}},
    }},
    {"Pieces", {
      {.name = "pieces", .kind = Kind::choice, .usual = "parts",
       .choices = {{"few", {"few, large", "wenige, große"}},
                   {"parts", {"one for each part", "eines je Körperteil"}},
                   {"small", {"many, small", "viele, kleine"}}},
       .help = "few: as few pieces as paper and overlap allow; parts: those of the model, crumbs joined to "
       "their neighbours; small: small ones (parts).",
       .setting = "pieces", .noted = Noted::with_pages, .keyword = "pieces",
       .studio = {"pieces", {"How many", "Wie viele"}, {}, {}, false}},
      {.name = "rolled", .kind = Kind::choice, .usual = "auto",
       .choices = {{"auto", {"where that is less work", "wo das weniger Arbeit ist"}},
                   {"never", {"never", "nie"}}, {"always", {"wherever paper bends so", "wo Papier sich so biegt"}}},
       .help = "Roll walls that are round one way, instead of folding them line by line: where that is less "
       "work, never, or wherever the sheet can be bent so, round 3 mm and more (auto; never with --pieces few).",
       .setting = "rolled", .keyword = "rolled",
       .studio = {"pieces", {"Round walls are rolled", "Runde Wände werden gerollt"}}},
      {.name = "max-faces", .kind = Kind::whole, .takes = "N|any",
       .choices = {{"any"}},
       .help = "Most flat faces of one piece (few: any, parts: 80, small: 24).",
       .setting = "max_faces", .noted = Noted::with_pages, .keyword = "max_faces",
       .studio = {"pieces", {"Faces of a piece at most", "Flächen eines Teils höchstens"}, {},
           {"a number, or any", "eine Zahl oder any"}}},
      {.name = "weigh", .kind = Kind::list, .takes = "TERM=WEIGHT", .high = 1e12,
       .help = "How much a property of nets counts when the best ones are chosen, in mm of seam. May be "
       "given for several terms:\n"
       "seam=1: a mm of seam to glue;\n"
       "bare=6: a mm of seam without room for a tab;\n"
       "slits=3: a mm of seam that hardly opens;\n"
       "mirror=1.5: a mm of seam whose image, mirrored or turned, is none;\n"
       "open=0.1: a mm of seam on smooth places;\n"
       "borders=0.7: a mm of fold where colours, materials or objects of the model meet;\n"
       "compact=5: a cm2 inside a piece's hull that is no paper;\n"
       "outline=0.5: the square of a piece's outline, over 1000 mm;\n"
       "thin=0.5: a mm by which what hangs on a neck is wider than three times the neck;\n"
       "pieces=360: a piece;\n"
       "parts=50: a further part in a piece;\n"
       "small=1200: a piece under 30 mm;\n"
       "panels=800: the square of a piece's flat faces, over 80.",
       .setting = "weigh_", .noted = Noted::with_pages, .keyword = "weigh",
       .studio = {"pieces", {"What counts", "Was zählt"}, {},
           {"such as pieces=100; bare=4", "etwa pieces=100; bare=4"}}},
      {.name = "fold-linear", .kind = Kind::flag,
       .help = "For sheets that fold themselves: every piece folds up with all creases moving together and "
       "no face running through another; pieces are split where no net does.",
       .setting = "fold_linear", .keyword = "fold_linear",
       .studio = {"machine", {"For sheets that fold themselves", "Für Bögen, die sich selbst falten"}}},
      {.name = "cuts", .kind = Kind::file,
       .help = "Edges to cut: two point numbers a line, counted as in the model's file (OBJ: from 1, others: "
       "from 0). Lines (l) of an OBJ and edges of a PLY file are cut, too.",
       .setting = "cuts"},
      {.name = "keep", .kind = Kind::file,
       .help = "Edges not to cut, in the same way; an edge in both is cut.",
       .setting = "keep"},
      {.name = "from", .kind = Kind::file,
       .help = "Nets of the same model made before (.fold, or .pdo of Pepakura Designer), edited or not: "
       "their cuts and folds are kept. Results go elsewhere (-o), unless --overwrite lets them replace this "
       "file.",
       .setting = "from"},
    }},
    {"Common", {
      {.name = "json", .kind = Kind::flag,
       .help = "Print one JSON object on standard output and nothing else there."},
      {.name = "quiet", .letter = "q", .kind = Kind::flag,
       .help = "Print no summary, notes or progress; errors only, and a result that goes into no file (info, "
       "formats)."},
      {.name = "verbose", .letter = "v", .kind = Kind::flag,
       .help = "Print all figures, where a summary of five lines stands otherwise."},
      {.name = "seed", .kind = Kind::whole, .takes = "N", .usual = "1",
       .help = "Seed of the random searches; the same seed gives the same bytes (1).",
       .setting = "seed", .noted = Noted::always,
       .studio = {"machine", {"Seed of the searches", "Startzahl der Suche"}}},
      {.name = "threads", .kind = Kind::whole, .takes = "N", .low = 1.0,
       .help = "Threads to use; the result doesn't depend on it (one per core)."},
      {.name = "time-limit", .kind = Kind::number, .takes = "SECONDS", .low = 0.001, .high = 1e6,
       .help = "End after about this time: searches stop with the best they have, a stage that has nothing "
       "yet stops the program (no limit)."},
    }},
  };
  // clang-format on
}

}  // namespace

const std::vector<Option>& option_table() {
  static const std::vector<Option> table = [] {
    std::vector<Option> all;
    for (const OptionGroup& group : option_groups()) {
      for (Option option : group.options) {
        option.group = group.title;
        all.push_back(std::move(option));
      }
    }
    return all;
  }();
  return table;
}

const std::vector<OptionRule>& option_rules() {
  static const std::vector<OptionRule> rules{
      {"size", false, "width"},
      {"size", false, "depth"},
      {"size", false, "height"},
      {"size", false, "scale"},
      {"width", false, "depth"},
      {"width", false, "height"},
      {"width", false, "scale"},
      {"depth", false, "height"},
      {"depth", false, "scale"},
      {"height", false, "scale"},
      {"unit", true, "scale", "why_unit"},
      {"all-tabs", false, "tabs=none"},
      {"tab-height", false, "tabs=none"},
      {"tab-angle", false, "tabs=none"},
      {"border-tabs", false, "tabs=none"},
      {"tab-shadow", false, "tabs=none"},
      {"tab-file", false, "tabs=none"},
      {"numbers=tabs", false, "tabs=none"},
      {"tab-height", false, "tabs=slots", "why_slots"},
      {"tab-angle", false, "tabs=slots", "why_slots"},
      {"tabs=slots", false, "thickness", "why_board_slots"},
      {"duplex", true, "numbers=back", "why_duplex"},
      {"dpi", false, "ink=lines", "why_dpi"},
      {"details=shade", false, "ink=lines", "why_dpi"},
      {"hinge", true, "thickness", "why_hinge"},
      {"spot", true, "preset=packaging", "why_spot"},
      {"bed", false, "paper", "why_bed"},
      {"print-and-cut", false, "bed", "why_print_and_cut"},
  };
  return rules;
}

const Option& option_row(std::string_view name) {
  const auto& table = option_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Option& o) { return o.name == name; });
  if (found == table.end()) {
    throw std::out_of_range("no option " + std::string(name));
  }
  return *found;
}

std::string value_name(const Option& option) {
  std::string words(option.takes);
  if (words.empty() && option.choices.empty()) {
    return option.kind == OptionKind::length  ? "LENGTH"
           : option.kind == OptionKind::angle ? "DEGREES"
           : option.kind == OptionKind::file  ? "FILE"
                                              : "";
  }
  if (words.empty()) {
    for (const OptionChoice& choice : option.choices) {
      if (choice.means.empty()) {
        words += (words.empty() ? "" : "|") + std::string(choice.word);
      }
    }
  }
  return words;
}

}  // namespace ridgecraft
