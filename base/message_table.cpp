// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.hpp"

namespace ridgecraft {
namespace {

using Rows = std::vector<MessageRow>;

// A text would put each column on lines of its own.
// clang-format off

Rows general_messages() {
  return {
      {"plain", "{text}", "{text}"},
      {"of_model", "{model}: {what}", "{model}: {what}"},
      {"memory", "{model} needs more memory than this machine has",
       "{model} braucht mehr Speicher, als dieser Rechner hat"},
      {"memory_in_browser", "the model needs more memory than a browser gives a page",
       "das Modell braucht mehr Speicher, als ein Browser einer Seite gibt"},
      {"internal", "internal error: {text}", "interner Fehler: {text}"},
      {"failed_check", "the nets fail their check and weren't written ({fault})",
       "die Abwicklungen bestehen ihre Prüfung nicht und wurden nicht geschrieben ({fault})"},
  };
}

Rows instead_messages() {
  return {
      {"instead", "this result {what}, since the first one failed its check ({fault})",
       "dieses Ergebnis {what}, da das erste seine Prüfung nicht bestand ({fault})"},
      {"instead_seed", "is that of another --seed", "ist das eines anderen --seed"},
      {"instead_bodies", "keeps the bodies of the file, as --keep-bodies does",
       "behält die Körper der Datei wie mit --keep-bodies"},
      {"instead_regions", "has a piece for each flat region", "hat ein Teil für jede ebene Fläche"},
      {"instead_tabs", "has no tabs", "hat keine Laschen"},
      {"not_glued", "{n} {n|body has|bodies have} no glue outline, as theirs failed the check",
       "{n} {n|Körper hat|Körper haben} keinen Klebeumriss, da ihrer die Prüfung nicht bestand"},
  };
}

Rows roll_messages() {
  return {
      {"roll", "roll, radius {mm} mm", "rollen, Radius {mm} mm"},
      {"roll_inside", "roll, print inside, radius {mm} mm", "rollen, Druck nach innen, Radius {mm} mm"},
      {"roll_cone", "roll, radius {from} to {to} mm", "rollen, Radius {from} bis {to} mm"},
      {"roll_cone_inside", "roll, print inside, radius {from} to {to} mm",
       "rollen, Druck nach innen, Radius {from} bis {to} mm"},
      {"round_pen", "a pen of {mm} mm", "einen Stift von {mm} mm"},
      {"round_tube", "a tube of {mm} mm", "ein Rohr von {mm} mm"},
      {"round_edge", "the edge of a table", "eine Tischkante"},
      {"board_too_stiff",
       "{n|one line is|# lines are} folded that paper would be rolled at: board of {thickness} mm bends no "
       "tighter than {radius} mm",
       "{n|eine Linie wird|# Linien werden} gefaltet, wo Papier gerollt würde: Pappe von {thickness} mm biegt sich "
       "nicht enger als {radius} mm"},
  };
}

Rows option_messages() {
  return {
      {"option_length", "{option} takes a length such as 150mm, 15cm or 6in, not '{text}'",
       "{option}: eine Länge wie 150mm, 15cm oder 6in, nicht „{text}“"},
      {"option_length_range", "{option} takes {low} to {high}mm, not '{text}'",
       "{option}: {low} bis {high}mm, nicht „{text}“"},
      {"option_length_low", "{option} {text} is too small: it takes {low}mm and more",
       "{option}: {text} ist zu klein, mindestens {low}mm sind nötig"},
      {"option_decimal_point", "{option} takes a decimal point: {option} {value}",
       "{option}: statt des Kommas ein Punkt, also {value}"},
      {"option_unit", "{option} takes mm, cm, m, in or ft, not '{text}'",
       "{option}: mm, cm, m, in oder ft, nicht „{text}“"},
      {"option_number", "{option} takes a number from {low} to {high}, not '{text}'",
       "{option}: eine Zahl von {low} bis {high}, nicht „{text}“"},
      {"option_percentage", "{option} takes a percentage from {low} to {high}, not '{text}'",
       "{option}: {low} bis {high} Prozent, nicht „{text}“"},
      {"option_whole", "{option} takes a whole number from {low} to {high}, not '{text}'",
       "{option}: eine ganze Zahl von {low} bis {high}, nicht „{text}“"},
      {"option_whole_from", "{option} takes a whole number from {low} on, not '{text}'",
       "{option}: eine ganze Zahl ab {low}, nicht „{text}“"},
      {"option_word", "{option} takes {words, or}, not '{text}'", "{option}: {words, oder}, nicht „{text}“"},
      {"option_scale", "{option} takes a factor such as 1:50, 0.5 or 30%, not '{text}'",
       "{option}: ein Faktor wie 1:50, 0.5 oder 30%, nicht „{text}“"},
      {"option_steps", "{option} takes a value for short edges, then lengths of edges from which on others count, such as {example}",
       "{option}: ein Wert für kurze Kanten, dann Längen von Kanten, ab denen andere gelten, etwa {example}"},
      {"option_max_faces", "{option} takes a number of faces from 1, or any",
       "{option}: eine Zahl von Flächen ab 1, oder any"},
      {"option_weigh", "{option} takes a term and its weight, such as pieces=10; the terms are {words, or}, not '{text}'",
       "{option}: ein Posten und sein Gewicht, etwa pieces=10; Posten sind {words, und}, nicht „{text}“"},
      {"option_calibrate", "{option} takes what 100 mm came out as, across and up, such as 100.4x99.6, each from 95 to 105; not '{text}'",
       "{option}: was aus 100 mm geworden ist, quer und längs, etwa 100.4x99.6, je 95 bis 105; nicht „{text}“"},
      {"option_colours", "{option} takes colours such as #ff8000, not '{text}'",
       "{option}: Farben wie #ff8000, nicht „{text}“"},
      {"option_colour", "{option} takes OPERATION=#RRGGBB with {words, or} for the operation, not '{text}'",
       "{option}: ARBEITSSCHRITT=#RRGGBB; Arbeitsschritte sind {words, und}, nicht „{text}“"},
      {"option_spot", "{option} takes STEP=NAME with cut, perforate, crease or glue for the step, and letters, digits, - and _ for the name, not '{text}'",
       "{option}: SCHRITT=NAME mit cut, perforate, crease oder glue, der Name aus Buchstaben, Ziffern, - und _; nicht „{text}“"},
      {"options_exclude", "{a} and {b} exclude each other", "{a} und {b} schließen sich aus"},
      {"options_exclude_why", "{a} and {b} exclude each other: {why}", "{a} und {b} schließen sich aus: {why}"},
      {"options_need", "{a} goes with {b}: {why}", "{a} geht nur mit {b}: {why}"},
      {"why_unit", "it says what the file's numbers mean", "so ist gemeint, was die Zahlen der Datei bedeuten"},
      {"why_slots", "tabs in slits have the shape that holds there", "Laschen in Schlitzen haben die Form, die dort hält"},
      {"why_board_slots", "tabs of board don't bend through a slit", "Laschen aus Pappe gehen nicht durch einen Schlitz"},
      {"why_duplex", "it says how sheets are turned over", "so ist gemeint, wie Bögen gewendet werden"},
      {"why_dpi", "there are no printed pictures then", "gedruckte Bilder gibt es dann nicht"},
      {"why_hinge", "it is about thick sheets", "es geht um dicke Bögen"},
      {"why_spot", "it names inks of a packaging shop's PDF", "es sind Farbnamen im PDF einer Verpackungsfirma"},
      {"why_bed", "both name the sheet", "beide nennen den Bogen"},
      {"why_print_and_cut", "--paper names the printer's sheet", "den Bogen des Druckers nennt das Papier"},
      {"preset_has_no_pictures", "{option} is about printed pictures; with a machine's preset there are none",
       "{option}: gedruckte Bilder gibt es bei Dateien für Maschinen nicht"},
      {"for_machines_only", "{option} is about files for machines: --preset names one, or -o such a file (NAME.dxf)",
       "{option} gilt nur für Dateien für Maschinen; dort ist eine zu wählen"},
      {"simulator_cuts_nothing", "{option} is about what is cut; a simulator of folding cuts nothing",
       "{option} betrifft, was geschnitten wird; ein Simulator schneidet nichts"},
      {"print_and_cut_needs_machine", "{option} needs a machine that cuts: {try} or another",
       "{option} braucht eine Maschine, die schneidet: {try} oder eine andere"},
      {"own_marks", "{option}: {preset} adds registration marks of its own to what is printed",
       "{option}: {preset} druckt eigene Passermarken dazu"},
      {"back_of_machine_file", "{option} prints on the other side of the sheet, which files of {preset} don't have; without it numbers stand on the pieces",
       "{option} druckt auf die Rückseite, die Dateien für {preset} nicht haben; ohne das stehen Nummern auf den Teilen"},
      {"back_of_dxf", "{option} prints on the other side of the sheet, which DXF and other files for machines don't have",
       "{option} druckt auf die Rückseite, die DXF und andere Dateien für Maschinen nicht haben"},
      {"no_dxf_written", "{option} says which DXF, and none is written: name one (-o NAME.dxf) or a preset with DXF ({try})",
       "{option} sagt, welches DXF, und keines wird geschrieben: nötig sind Dateien mit DXF ({try})"},
      {"page_of_board", "-o {file} names a page, which shows nets of paper; with --thickness other nets lie on the sheets",
       "{file} zeigt Abwicklungen aus Papier; mit einer Dicke liegen andere auf den Bögen"},
      {"edges_and_faces", "{option} names edges of the model as it is, and {faces} would leave others: give one of the two",
       "{option} nennt Kanten des Modells, wie es ist, und {faces} ließe andere übrig: nur eines von beiden geht"},
  };
}

Rows paper_messages() {
  return {
      {"paper_side", "paper '{text}' has a side of {mm} mm", "Papier „{text}“ hat eine Seite von {mm} mm"},
      {"paper_small", "paper '{text}' is too small: one side has {mm} mm, at least {least} mm are needed",
       "Papier „{text}“ ist zu klein: eine Seite hat {mm} mm, nötig sind mindestens {least} mm"},
      {"paper_large", "paper '{text}' is too large: one side has {m} m, {most} m are the limit",
       "Papier „{text}“ ist zu groß: eine Seite hat {m} m, höchstens {most} m gehen"},
      {"paper_nearest", "unknown paper '{text}', did you mean '{nearest}'?",
       "unbekanntes Papier „{text}“; gemeint „{nearest}“?"},
      {"paper_unknown", "unknown paper '{text}': A0 to A7, B0 to B6, Letter, Legal and others have names; give the size of any other sheet, such as 210x297mm",
       "unbekanntes Papier „{text}“: Namen haben A0 bis A7, B0 bis B6, Letter, Legal und andere; sonst geht eine Größe wie 210x297mm"},
      {"paper_margin", "the page margin can't be {mm} mm", "der Rand der Seite kann nicht {mm} mm sein"},
      {"paper_gap", "the gap between pieces can't be {mm} mm", "der Abstand der Teile kann nicht {mm} mm sein"},
      {"paper_full", "paper of {width} x {height} mm with margins of {margin} mm leaves no room for pieces",
       "Papier von {width} x {height} mm mit Rändern von {margin} mm lässt keinen Platz für Teile"},
      {"paper_too_long_for_pdf", "paper of {width} x {height} mm is too long for PDF, whose pages end at {most} mm; SVG has no such limit (-o NAME.svg)",
       "Papier von {width} x {height} mm ist für PDF zu lang, dessen Seiten bei {most} mm enden; SVG hat keine solche Grenze"},
      {"narrow_margin", "most printers don't reach the outer {reach} mm of a sheet: a margin of {mm} mm is for cutting machines",
       "die meisten Drucker erreichen die äußeren {reach} mm eines Bogens nicht: ein Rand von {mm} mm ist für Schneidemaschinen"},
  };
}

Rows size_messages() {
  return {
      {"assumed_unit", "{asked} has no unit, so it means {mm} mm; {try} makes a model ten times as large",
       "{asked} hat keine Einheit und bedeutet {mm} mm; {try} ergibt ein zehnmal so großes Modell"},
      {"odd_scale", "{asked} makes the model {mm} mm large, as its file doesn't say what its numbers mean; add --unit m, cm, mm, in or ft",
       "mit {asked} wird das Modell {mm} mm groß, denn seine Datei sagt nicht, was ihre Zahlen bedeuten; nötig ist eine Einheit der Datei"},
      {"no_width", "the model is flat and has no width", "das Modell ist flach und hat keine Breite"},
      {"no_depth", "the model is flat and has no depth", "das Modell ist flach und hat keine Tiefe"},
      {"no_height", "the model is flat and has no height", "das Modell ist flach und hat keine Höhe"},
      {"larger_than_100_m", "the model would be larger than 100 m; choose a smaller size or scale",
       "das Modell wäre größer als 100 m; nötig ist eine kleinere Größe oder ein kleinerer Maßstab"},
      {"smaller_than_100_um", "the model would be smaller than 0.1 mm; choose a larger size or scale",
       "das Modell wäre kleiner als 0,1 mm; nötig ist eine größere Größe oder ein größerer Maßstab"},
      {"all_too_narrow", "every face is too narrow to be cut from paper at this size",
       "in dieser Größe ist jede Fläche zu schmal, um sie aus Papier zu schneiden"},
      {"too_large_for_paper", "the model is far too large for this paper; choose a smaller size",
       "das Modell ist für dieses Papier viel zu groß; nötig ist eine kleinere Größe"},
      {"face_too_large", "face {face} is larger than the printable area of the paper",
       "Fläche {face} ist größer als das, was auf dem Papier bedruckt werden kann"},
      {"unknown_object", "nothing in the model is named '{name}'; there are {names, and}",
       "nichts im Modell heißt „{name}“; es gibt {names, und}"},
      {"no_names", "nothing in the model is named '{name}'; it has no names",
       "nichts im Modell heißt „{name}“; es hat keine Namen"},
      {"more_names", "{n} more", "{n} weitere"},
      {"nothing_left", "nothing is left of the model: no face has a name that is wanted and none that isn't",
       "vom Modell bleibt nichts übrig: Keine Fläche hat einen Namen, der bleiben soll, und keinen, der fehlen soll"},
      {"unbuildable", "can't be built at {mm} mm: {reasons, and}; {help}",
       "nicht baubar bei {mm} mm: {reasons, und}; {help}"},
      {"short_folds_share", "{percent} % of the folds are shorter than {mm} mm",
       "{percent} % der Falze sind kürzer als {mm} mm"},
      {"narrow_faces_share", "{percent} % of the faces are narrower than {mm} mm",
       "{percent} % der Flächen sind schmaler als {mm} mm"},
      {"options_help", "{ways, or} can", "baubar mit {ways, oder}"},
      {"nothing_helps", "no option that was tried helps", "keine Option, die versucht wurde, hilft"},
      {"no_evening", "no evening's work: {ways, or} would be", "keine Arbeit für einen Abend; das wäre {ways, oder}"},
      {"other_size", "--size {value}mm ({hours} hours)", "--size {value}mm ({hours} Stunden)"},
      {"fewer_faces", "--faces {value} ({hours} hours)", "--faces {value} ({hours} Stunden)"},
      {"without_name", "--without '{value}' ({hours} hours)", "--without '{value}' ({hours} Stunden)"},
      {"many_pages", "this takes about {pages} pages; {try} would take about {fewer}",
       "das braucht etwa {pages} Seiten; {try} bräuchte etwa {fewer}"},
      {"many_pages_counted", "this takes {pages} pages; {try} would take about {fewer}",
       "das braucht {pages} Seiten; {try} bräuchte etwa {fewer}"},
      {"many_bodies", "this takes about {pages} pages or more, for {bodies} separate bodies",
       "das braucht etwa {pages} Seiten oder mehr, für {bodies} einzelne Körper"},
      {"short_folds", "half of the folds are shorter than {mm} mm, too short for fingers; {try} makes half of them {easy} mm and longer",
       "die Hälfte der Falze ist kürzer als {mm} mm, zu kurz für Finger; mit {try} ist die Hälfte {easy} mm lang und länger"},
      {"too_many_pages", "at {size} the model takes about {pages} pages, and more than {most} aren't made unasked: {try} takes about {fewer}, {go_on} goes on",
       "bei {size} braucht das Modell etwa {pages} Seiten, und mehr als {most} werden ungefragt nicht gemacht: {try} braucht etwa {fewer}, {go_on} macht weiter"},
      {"too_many_bodies", "the model has {bodies} separate bodies, which take about {pages} pages at any size, and more than {most} aren't made unasked: --only NAME takes some of them, ridgecraft unfold makes their nets without pages, {try} goes on",
       "das Modell hat {bodies} einzelne Körper, die in jeder Größe etwa {pages} Seiten brauchen, und mehr als {most} werden ungefragt nicht gemacht: Einzelne Objekte lassen sich auswählen; {try} macht weiter"},
  };
}

/// Why a join has no tab: "no_tab_" and the name of unfold::NoTab.
Rows no_tab_messages() {
  return {
      {"no_tab_edge_too_short", "the edge is too short for a tab", "die Kante ist zu kurz dafür"},
      {"no_tab_no_room", "a tab on either side would lie over a face or another tab",
       "auf beiden Seiten läge sie über einer Fläche oder einer anderen Lasche"},
      {"no_tab_target_too_small", "a tab would stick out behind the face it is glued to",
       "sie stünde hinter der Fläche vor, an die sie geklebt wird"},
      {"no_tab_too_little_paper", "a tab would hang on less than 2 mm of paper",
       "sie hinge an weniger als 2 mm Papier"},
      {"no_tab_beyond_sheet", "the piece with the tab would not fit the paper",
       "mit ihr wäre das Teil zu groß fürs Papier"},
      {"no_tab_not_wanted", "tabs are switched off", "Laschen sind abgeschaltet"},
      {"no_tab_time_up", "time limit reached before a tab could be placed",
       "die Zeit war um, bevor ein Platz dafür gefunden war"},
  };
}

/// Why pieces are pieces of their own.
Rows piece_messages() {
  return {
      {"piece_part", "a part of the model", "ein Teil des Modells"},
      {"piece_page", "one piece with {n|its neighbour|their neighbours} wouldn't fit the paper",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} zu groß für das Papier"},
      {"piece_overlap", "one piece with {n|its neighbour|their neighbours} would overlap itself",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} nicht ohne Überlappung"},
      {"piece_no_net", "{n|its part has no net that doesn't overlap itself|their parts have no nets that don't overlap themselves} (proven)",
       "für {n|seinen|ihre} Körperteil{n||e} gibt es bewiesenermaßen keine Abwicklung ohne Überlappung"},
      {"piece_tabs", "one piece with {n|its neighbour|their neighbours} would have no room for some tabs",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} ohne Platz für manche Laschen"},
      {"piece_faces", "one piece with {n|its neighbour|their neighbours} would have more than {most} flat faces ({option}, --pieces few)",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} mehr als {most} ebene Flächen ({option}, --pieces few)"},
      {"piece_time", "the time was up before it was tried with {n|its neighbour|their neighbours}",
       "die Zeit war um, bevor es mit {n|seinem Nachbarn|ihren Nachbarn} versucht war"},
      {"piece_request", "cut here on request", "hier auf Wunsch geschnitten"},
      {"piece_component", "{n|its part isn't|their parts aren't} connected",
       "{n|sein Körperteil hängt|ihre Körperteile hängen} nicht zusammen"},
      {"piece_folding", "one piece with {n|its neighbour|their neighbours} wouldn't fold up with all creases together ({option})",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} nicht mit allen Falzen zugleich zu falten ({option})"},
      {"piece_shape", "one piece with {n|its neighbour|their neighbours} would be hard to cut out or to fold",
       "in einem Stück mit {n|seinem Nachbarn|ihren Nachbarn} schwer auszuschneiden oder zu falten"},
  };
}

/// What was decided about nets.
Rows note_messages() {
  return {
      {"names", "{names, and}", "{names, und}"},
      {"large_regions_cut", "{n} flat {n|region is|regions are} larger than the printable area, so cut",
       "{n} ebene {n|Fläche ist|Flächen sind} größer als der bedruckbare Bereich und darum zerschnitten"},
      {"split_for_tabs", "{n} {n|piece was|pieces were} split off for tabs", "{n} {n|Teil wurde|Teile wurden} für Laschen abgetrennt"},
      {"none_split_for_tabs", "no piece had to be split off for tabs", "kein Teil musste für Laschen abgetrennt werden"},
      {"too_narrow_for_tabs", "{n} {n|edge is too short, or the faces behind it|edges are too short, or the faces behind them} too narrow, for a tab that holds",
       "{n} {n|Kante ist|Kanten sind} zu kurz oder die Flächen dahinter zu schmal für eine Lasche, die hält"},
      {"still_no_room", "{n} {n|edge has|edges have} no room for a tab even so", "{n} {n|Kante hat|Kanten haben} auch so keinen Platz für eine Lasche"},
      {"no_room_yet", "{n} {n|edge has|edges have} no room for a tab yet", "{n} {n|Kante hat|Kanten haben} noch keinen Platz für eine Lasche"},
      {"splits_untried", "time limit reached before all ways to split were tried",
       "die Zeit war um, bevor alle Teilungen versucht waren"},
      {"tabs_untried", "time limit reached before all nets with more tabs were tried",
       "die Zeit war um, bevor alle Abwicklungen mit mehr Laschen versucht waren"},
      {"all_of", "{facts}", "{facts}"},
      {"split_to_fold", "{n} {n|piece was|pieces were} split off so that all fold up with all creases together",
       "{n} {n|Teil wurde|Teile wurden} abgetrennt, damit sich alle mit allen Falzen zugleich falten"},
      {"none_split_to_fold", "no piece had to be split off so that all fold up with all creases together",
       "kein Teil musste abgetrennt werden, damit sich alle mit allen Falzen zugleich falten"},
      {"dont_fold_together", "{n} {n|piece doesn't|pieces don't} fold up with all creases together all the same: edges that were to be kept are in the way of splitting further",
       "{n} {n|Teil faltet|Teile falten} sich trotzdem nicht mit allen Falzen zugleich: Kanten, die bleiben sollten, verhindern weitere Teilung"},
      {"kept_edges_cut", "{n} {n|edge that was|edges that were} to be kept are cut: as folds they would close a loop, overlap or fit no page",
       "{n} {n|Kante, die bleiben sollte, ist|Kanten, die bleiben sollten, sind} geschnitten: Als Falze schlössen sie einen Ring, überlappten oder passten auf keine Seite"},
      {"simplified_as_before", "the model is simplified as it was for {file}", "das Modell ist vereinfacht wie für {file}"},
      {"cuts_in_flat", "{n} of {all} edges to be cut lie inside flat regions, which stay whole",
       "{n} von {all} Kanten zum Schneiden liegen in ebenen Flächen, und die bleiben ganz"},
      {"cuts_lost", "{n} of {all} edges to be cut are no edges of the model on paper",
       "{n} von {all} Kanten zum Schneiden sind keine Kanten des Modells auf Papier"},
      {"keeps_in_flat", "{n} of {all} edges to be kept lie inside flat regions, which stay whole",
       "{n} von {all} Kanten zum Falten liegen in ebenen Flächen, und die bleiben ganz"},
      {"keeps_lost", "{n} of {all} edges to be kept are no edges of the model on paper",
       "{n} von {all} Kanten zum Falten sind keine Kanten des Modells auf Papier"},
      {"cut_and_kept", "{n} {n|edge|edges} to be kept {n|is|are} to be cut, too, and {n|is|are} cut",
       "{n} {n|Kante|Kanten} zum Falten {n|soll|sollen} auch geschnitten werden und {n|ist|sind} geschnitten"},
      {"old_edges_lost", "{n} of {all} edges of {file} are no edges of the model on paper",
       "{n} von {all} Kanten aus {file} sind keine Kanten des Modells auf Papier"},
      {"nets_of_another_model", "{file} holds nets of another model: {n} of {all} edges don't lie on an edge of this one",
       "{file} enthält Abwicklungen eines anderen Modells: {n} von {all} Kanten liegen auf keiner Kante von diesem"},
      {"no_such_point", "an edge is named by point {point}, counted from 0, and the model was read with {all}",
       "eine Kante nennt den Punkt {point}, von 0 an gezählt, und das Modell hat {all}"},
      {"most_edges_marked", "the file marks most of its edges, so they aren't taken for cuts",
       "die Datei markiert die meisten ihrer Kanten, darum gelten sie nicht als Schnitte"},
      {"marked_so_unsimplified", "the file marks edges to cut, so the model isn't simplified",
       "die Datei markiert Kanten zum Schneiden, darum wird das Modell nicht vereinfacht"},
      {"points_outside", "{n} of {all} {all|point|points} lie outside {file}, where they follow it less well",
       "{n} von {all} {all|Punkt|Punkten} liegen außerhalb von {file} und folgen ihm weniger gut"},
      {"hulls_uncovered", "{percent} % of the model's volume is in no hull: what is left is too thin to be filled",
       "{percent} % des Volumens liegen in keiner Hülle: Was übrig ist, ist zu dünn zum Füllen"},
      {"hulls_of_open", "no component of the model is closed, so hulls cover its surface alone",
       "kein Teil des Modells ist geschlossen, darum decken die Hüllen nur seine Oberfläche"},
      {"hulls_close_openings", "{n} {n|hull closes|hulls close} openings or hollows of the model: --pockets keeps them open, narrow ones with --concavity 0.01",
       "{n} {n|Hülle schließt|Hüllen schließen} Öffnungen oder Hohlräume des Modells: --pockets hält sie offen, schmale mit --concavity 0.01"},
      {"no_time_for_parts", "--time-limit was too short to find parts: each component is one part",
       "die Zeit war zu kurz, um Körperteile zu finden: Jede Komponente ist einer"},
      {"too_thick_for_edges", "the sheet is too thick for {n} {n|edge|edges}, where a face would have lost a third of its height",
       "der Bogen ist für {n} {n|Kante|Kanten} zu dick, wo eine Fläche ein Drittel ihrer Höhe verloren hätte"},
      {"cut_as_of_paper", "{n} {n|piece|pieces} would have lain on {n|itself|themselves} with room for the thickness, so {n|it is|they are} cut as of paper",
       "{n} {n|Teil hätte|Teile hätten} mit Platz für die Dicke auf sich selbst gelegen und {n|ist|sind} darum wie aus Papier geschnitten"},
  };
}

/// Why an edit by hand is refused.
Rows edit_messages() {
  return {
      {"no_such_edge", "the model has no such edge", "das Modell hat keine solche Kante"},
      {"no_such_face", "the model has no such face", "das Modell hat keine solche Fläche"},
      {"no_such_page", "there is no such page", "diese Seite gibt es nicht"},
      {"pages_differ", "the faces at this edge belong on different pages",
       "die Flächen an dieser Kante gehören auf verschiedene Seiten"},
      {"nothing_to_cut", "the model ends at this edge, so there is nothing to cut",
       "das Modell endet an dieser Kante, zu schneiden ist hier nichts"},
      {"nothing_to_join", "the model ends at this edge, so there is nothing to join",
       "das Modell endet an dieser Kante, zu verbinden ist hier nichts"},
      {"cut_already", "this edge is cut already", "hier ist schon geschnitten"},
      {"fold_already", "this edge is a fold already", "hier ist schon gefaltet"},
      {"inside_flat_region", "this edge lies inside a flat region, which stays whole",
       "diese Kante liegt in einer ebenen Fläche, und die bleibt ganz"},
      {"cut_parts_nothing", "the paper holds together around this edge, so a cut here parts nothing",
       "das Papier hängt um diese Kante herum zusammen, ein Schnitt hier trennt nichts"},
      {"closes_loop", "both sides of this edge belong to piece {a}, and as a fold it would close a loop that doesn't lie flat",
       "beide Seiten dieser Kante gehören zu Teil {a}; als Falz schlösse sie einen Ring, der nicht flach liegt"},
      {"would_overlap", "joined here pieces {a} and {b} would overlap", "hier verbunden lägen die Teile {a} und {b} übereinander"},
      {"larger_than_paper", "pieces {a} and {b} stay apart: joined they would be larger than the paper",
       "die Teile {a} und {b} bleiben getrennt: zusammen sind sie größer als das Papier"},
      {"wouldnt_fold_together", "pieces {a} and {b} stay apart: joined they wouldn't fold with all creases together",
       "die Teile {a} und {b} bleiben getrennt: zusammen ließen sie sich nicht mit allen Falzen zugleich falten"},
      {"no_other_net", "no other net of piece {a} was found", "für Teil {a} wurde keine andere Abwicklung gefunden"},
      {"no_room_for_tab", "there is no room for a usable tab on this side",
       "auf dieser Seite ist kein Platz für eine brauchbare Lasche"},
      {"made_without_tabs", "these nets are made without tabs", "diese Abwicklungen sind ohne Laschen"},
      {"only_glued_edges", "only an edge that is glued has a tab", "eine Lasche hat nur eine Kante, die geklebt wird"},
      {"pinned", "piece {a} is pinned", "Teil {a} wird festgehalten"},
      {"pinned_already", "piece {a} is pinned already", "Teil {a} wird schon festgehalten"},
      {"not_pinned", "piece {a} isn't pinned", "Teil {a} wird nicht festgehalten"},
      {"no_room_when_pinned", "piece {a} is pinned, and with the tabs that it would get it has no room there",
       "Teil {a} wird festgehalten und hätte dort mit seinen neuen Laschen keinen Platz"},
      {"beyond_sheet", "piece {a} would leave the part of the page that is for pieces",
       "Teil {a} läge außerhalb der Fläche, die auf der Seite für Teile ist"},
      {"too_near", "there piece {a} would lie on piece {b}, or nearer to it than {n} mm",
       "dort läge Teil {a} auf Teil {b} oder näher daran als {n} mm"},
      {"different_pages", "pieces {a} and {b} belong on different pages", "die Teile {a} und {b} gehören auf verschiedene Seiten"},
      {"pages_of_board", "pages of board are filled by the program alone", "Seiten aus Pappe füllt das Programm allein"},
      {"no_pages", "nets without pages have no places", "ohne Seiten haben Abwicklungen keine Plätze"},
  };
}

/// What was repaired or is unusual: "repair_" and the name of mesh::RepairKind.
Rows repair_messages() {
  return {
      {"with_detail", "{what} ({detail})", "{what} ({detail})"},
      {"repair_content_is_other_format", "{n|the file's suffix names another format than its content has|# files have a suffix that names another format than their content has}; the content was read",
       "{n|die Endung der Datei nennt ein anderes Format, als ihr|# Dateien haben eine Endung, die ein anderes Format nennt, als ihr} Inhalt hat; gelesen wurde der Inhalt"},
      {"repair_trailing_data_ignored", "{n} {n|byte after the end of the mesh was|bytes after the end of the mesh were} ignored",
       "{n} {n|Byte hinter dem Ende des Netzes wurde|Bytes hinter dem Ende des Netzes wurden} übergangen"},
      {"repair_count_corrected", "{n|a count in the file's header was wrong and was|# counts in the file's header were wrong and were} corrected",
       "{n|eine Anzahl im Kopf der Datei war falsch und wurde|# Anzahlen im Kopf der Datei waren falsch und wurden} berichtigt"},
      {"repair_missing_end", "{n|the file's end mark is|# end marks are} missing, but the mesh is complete",
       "{n|die Endmarke der Datei fehlt|# Endmarken fehlen}, aber das Netz ist vollständig"},
      {"repair_material_file_missing", "{n|a material file wasn't found or can't be read: its|# material files weren't found or can't be read: their} colours are missing",
       "{n|eine Materialdatei fehlt oder ist nicht lesbar: Ihre|# Materialdateien fehlen oder sind nicht lesbar: Ihre} Farben fehlen"},
      {"repair_material_unknown", "{n} {n|material is used but defined nowhere; its|materials are used but defined nowhere; their} faces stay white",
       "{n} {n|Material ist benutzt, aber nirgends beschrieben; seine|Materialien sind benutzt, aber nirgends beschrieben; ihre} Flächen bleiben weiß"},
      {"repair_material_value_corrected", "{n} {n|colour of a material was|colours of materials were} out of range and {n|was|were} corrected",
       "{n} {n|Farbe eines Materials lag|Farben von Materialien lagen} außerhalb des Bereichs und {n|wurde|wurden} berichtigt"},
      {"repair_texture_missing", "{n|a texture picture is|# texture pictures are} missing or can't be used",
       "{n|ein Texturbild fehlt oder ist|# Texturbilder fehlen oder sind} nicht brauchbar"},
      {"repair_texture_point_dropped", "{n} {n|face has|faces have} texture coordinates that are missing or can't be used; {n|it gets|they get} no picture",
       "{n} {n|Fläche hat|Flächen haben} fehlende oder unbrauchbare Texturkoordinaten und {n|bekommt|bekommen} kein Bild"},
      {"repair_element_ignored", "{n} {n|element that is no face was|elements that are no faces were} ignored",
       "{n} {n|Element, das keine Fläche ist, wurde|Elemente, die keine Flächen sind, wurden} übergangen"},
      {"repair_object_left_out", "{n} {n|part that the file marks as no part of the model is|parts that the file marks as no parts of the model are} left out",
       "{n} {n|Teil, das laut Datei nicht zum Modell gehört, ist|Teile, die laut Datei nicht zum Modell gehören, sind} weggelassen"},
      {"repair_feature_ignored", "{n|something in the file isn't used|# things in the file aren't used}",
       "{n|etwas in der Datei wird nicht benutzt|# Dinge in der Datei werden nicht benutzt}"},
      {"repair_motion_ignored", "{n|the model moves in its file; it was|# models move in their files; they were} taken at rest",
       "{n|das Modell bewegt sich in seiner Datei; es wurde|# Modelle bewegen sich in ihren Dateien; sie wurden} in Ruhe genommen"},
      {"repair_points_joined", "{n|1 point was joined with another at the same place|# points at equal places were joined}",
       "{n|1 Punkt wurde mit einem anderen am selben Ort|# Punkte am selben Ort wurden} verbunden"},
      {"repair_border_points_joined", "{n|1 point on a border was joined with another very close to it|# points on borders were joined with others very close to them}",
       "{n|1 Punkt an einem Rand wurde mit einem|# Punkte an Rändern wurden mit anderen} dicht daneben verbunden"},
      {"repair_unused_points_dropped", "{n} {n|point that no face uses was|points that no face uses were} dropped",
       "{n} {n|Punkt, den keine Fläche benutzt, entfällt|Punkte, die keine Fläche benutzt, entfallen}"},
      {"repair_polygon_corner_dropped", "{n} {n|corner of a face that repeats its neighbour was|corners of faces that repeat their neighbours were} dropped",
       "{n} {n|Ecke einer Fläche, die ihre Nachbarin wiederholt, entfällt|Ecken von Flächen, die ihre Nachbarinnen wiederholen, entfallen}"},
      {"repair_polygons_dropped", "{n} {n|face with fewer than three different corners was|faces with fewer than three different corners were} dropped",
       "{n} {n|Fläche mit weniger als drei verschiedenen Ecken entfällt|Flächen mit weniger als drei verschiedenen Ecken entfallen}"},
      {"repair_crossed_polygons_rebuilt", "{n} {n|face that crosses itself was|faces that cross themselves were} rebuilt or left out",
       "{n} {n|Fläche, die sich selbst kreuzt, wurde|Flächen, die sich selbst kreuzen, wurden} neu gebildet oder weggelassen"},
      {"repair_bent_polygons_split", "{n} {n|face that isn't flat was|faces that aren't flat were} split into triangles",
       "{n} {n|Fläche, die nicht eben ist, wurde|Flächen, die nicht eben sind, wurden} in Dreiecke geteilt"},
      {"repair_duplicate_faces_dropped", "{n} {n|face that was there twice was|faces that were there more than once were} dropped",
       "{n} {n|Fläche, die es doppelt gab, entfällt|Flächen, die es mehrfach gab, entfallen}"},
      {"repair_inner_walls_dropped", "{n|1 wall between two bodies, there from either side, was dropped: they are|# walls between bodies, there from either side, were dropped: the bodies are} one",
       "{n|1 Wand zwischen zwei Körpern, die es von beiden Seiten gab, entfällt|# Wände zwischen Körpern, die es von beiden Seiten gab, entfallen}: die Körper sind einer"},
      {"repair_flat_faces_collapsed", "{n} {n|face without area was|faces without area were} removed",
       "{n} {n|Fläche ohne Inhalt wurde|Flächen ohne Inhalt wurden} entfernt"},
      {"repair_faces_turned", "{n} {n|face was turned around to agree with its|faces were turned around to agree with their} neighbours",
       "{n} {n|Fläche wurde gewendet und passt zu ihren|Flächen wurden gewendet und passen zu ihren} Nachbarn"},
      {"repair_components_turned", "{n} closed {n|piece that was inside out was|pieces that were inside out were} turned",
       "{n} {n|geschlossenes Stück, das umgestülpt war, wurde|geschlossene Stücke, die umgestülpt waren, wurden} gewendet"},
      {"repair_edges_paired", "{n} {n|edge has|edges have} more than two faces: those that belong together were joined in pairs",
       "{n} {n|Kante hat|Kanten haben} mehr als zwei Flächen: Zusammengehörige wurden paarweise verbunden"},
      {"repair_edges_split", "{n} {n|edge has|edges have} three or more faces: two of them stay joined at most, the others come apart",
       "{n} {n|Kante hat|Kanten haben} drei oder mehr Flächen: Höchstens zwei bleiben verbunden, die anderen trennen sich"},
      {"repair_vertices_split", "at {n} {n|point|points} parts of the surface only touch: they come apart",
       "an {n} {n|Punkt|Punkten} berühren sich Teile der Oberfläche nur: Sie trennen sich"},
      {"repair_cut_open", "{n} {n|edge was|edges were} cut open since the surface has only one side",
       "{n} {n|Kante wurde|Kanten wurden} aufgeschnitten, weil die Oberfläche nur eine Seite hat"},
      {"repair_t_junctions_joined", "{n} {n|point that lay on an edge without being joined to it is|points that lay on edges without being joined to them are} joined to {n|it|them} now",
       "{n} {n|Punkt, der auf einer Kante lag, ohne mit ihr verbunden zu sein, ist|Punkte, die auf Kanten lagen, ohne mit ihnen verbunden zu sein, sind} es jetzt"},
      {"repair_open_border", "the model isn't closed: {n} {n|edge has|edges have} a face on one side only",
       "das Modell ist nicht geschlossen: {n} {n|Kante hat|Kanten haben} nur auf einer Seite eine Fläche"},
      {"repair_self_intersections", "{n} {n|face runs through another|faces run through each other}",
       "{n} {n|Fläche durchdringt eine andere|Flächen durchdringen einander}"},
      {"repair_mended_intersections", "{n} {n|face|faces} ran through others: uniting the bodies has mended that",
       "{n} {n|Fläche durchdrang|Flächen durchdrangen} andere: Mit dem Vereinen der Körper ist das behoben"},
      {"repair_narrow_faces", "{n} {n|face is|faces are} narrower than 0.05 mm: on paper {n|it|each} is part of the face next to it",
       "{n} {n|Fläche ist|Flächen sind} schmaler als 0,05 mm: Auf Papier {n|gehört sie|gehören sie} zur Fläche daneben"},
  };
}

// clang-format on

}  // namespace

const std::vector<MessageRow>& message_table() {
  static const std::vector<MessageRow> table = [] {
    std::vector<MessageRow> all;
    for (const auto messages :
         {general_messages, instead_messages, roll_messages, option_messages, paper_messages, size_messages,
          no_tab_messages, piece_messages, note_messages, edit_messages, repair_messages}) {
      const Rows rows = messages();
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }();
  return table;
}

}  // namespace ridgecraft
