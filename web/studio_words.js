// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of the studio, which a page with one result doesn't need.

import {studioMessages} from "./message_words.js";
import {messages, sayMessage, texts} from "./words.js";

/** @typedef {import("./words.js").Message} Message */

Object.assign(messages, studioMessages);

Object.assign(texts, {
  studio_title: ["Ridgecraft: a model becomes paper", "Ridgecraft: aus einem Modell wird Papier"],
  drop_here: ["Drop a 3D model here", "3D-Modell hier ablegen"],
  drop_formats: ["OBJ with its materials and pictures, STL, PLY, OFF, GLB, 3MF or PDO. It stays on your computer: this page sends nothing anywhere.", "OBJ mit Materialien und Bildern, STL, PLY, OFF, GLB, 3MF oder PDO. Es bleibt auf Ihrem Rechner: Diese Seite sendet nichts."],
  choose_file: ["Choose a file …", "Datei wählen …"],
  or_sample: ["or begin with a sample", "oder mit einem Beispiel beginnen"],
  sample_whale: ["Whale", "Wal"],
  sample_house: ["House", "Haus"],
  sample_fox_head: ["Fox head", "Fuchskopf"],
  sample_rocket: ["Rocket", "Rakete"],
  open_other: ["Open another …", "Anderes öffnen …"],
  panel: ["Options", "Einstellungen"],
  more: ["More", "Mehr"],
  reset: ["Reset", "Zurücksetzen"],
  export_as: ["Save PDF, SVG …", "PDF, SVG … speichern"],
  tip: ["Click a fold to cut it, or a seam to join it; drag a piece to move it.", "Einen Falz anklicken, um dort zu schneiden, eine Naht, um zu verbinden; Teile lassen sich ziehen."],
  tip_touch: ["Tap a fold to cut it, a seam to join it, a piece to move it.", "Einen Falz antippen, um zu schneiden, eine Naht, um zu verbinden, ein Teil, um es zu bewegen."],
  open_options: ["Options", "Einstellungen"],
  whole_piece: ["Piece {name} …", "Teil {name} …"],
  format_pdf: ["PDF to print", "PDF zum Drucken"],
  format_guide: ["PDF: how to build it", "PDF: Bauanleitung"],
  format_svg: ["SVG", "SVG"],
  format_dxf: ["DXF for cutters", "DXF für Schneidemaschinen"],
  format_fold: ["FOLD: the nets", "FOLD: die Abwicklungen"],
  format_html: ["Web page of the result", "Webseite mit dem Ergebnis"],
  format_lbrn2: ["LightBurn project", "LightBurn-Projekt"],
  format_eps: ["EPS", "EPS"],
  format_plt: ["HPGL for roll plotters", "HPGL für Rollenplotter"],
  format_png: ["PNG pictures", "PNG-Bilder"],
  undo: ["Undo", "Rückgängig"],
  redo: ["Redo", "Wiederholen"],
  undo_title: ["Undo (Ctrl+Z)", "Rückgängig (Strg+Z)"],
  redo_title: ["Redo (Ctrl+Shift+Z)", "Wiederholen (Strg+Umschalt+Z)"],
  edit_edge: ["At this edge", "An dieser Kante"],
  cut_here: ["Cut here", "Hier schneiden"],
  join_here: ["Join here", "Hier verbinden"],
  tab_over: ["Tab to piece {name}", "Lasche an Teil {name}"],
  tab_over_own: ["Tab to the other side", "Lasche auf die andere Seite"],
  tab_on_again: ["Tab on piece {name}", "Mit Lasche an Teil {name}"],
  tab_off: ["No tab", "Ohne Lasche"],
  edit_piece: ["Piece {name}", "Teil {name}"],
  turn_left: ["Turn left by 90°", "Um 90° nach links drehen"],
  turn_right: ["Turn right by 90°", "Um 90° nach rechts drehen"],
  pack_piece: ["Find another place", "Anderen Platz suchen"],
  retry_piece: ["Another net", "Andere Abwicklung"],
  pin: ["Pin", "Festhalten"],
  unpin: ["Unpin", "Loslassen"],
  key_move: ["Move the piece by 5 mm", "Teil um 5 mm verschieben"],
  key_turn: ["Turn the piece by 15°; with Shift: to the right", "Teil um 15° drehen; mit Umschalt: nach rechts"],
  key_pin: ["Pin the piece, or unpin it", "Teil festhalten oder loslassen"],
  key_retry: ["Another net of the piece", "Andere Abwicklung des Teils"],
  key_pack: ["Find another place for the piece; for all, where none is chosen", "Anderen Platz für das Teil suchen; ist keines gewählt, für alle"],
  key_undo: ["Undo what was done by hand; with Shift: redo", "Änderung von Hand rückgängig machen; mit Umschalt: wiederholen"],
  edits_left_out_1: ["{n} change by hand can't be made on these nets and was left out.", "{n} Änderung von Hand ist an diesen Abwicklungen nicht möglich und entfällt."],
  edits_left_out_n: ["{n} changes by hand can't be made on these nets and were left out.", "{n} Änderungen von Hand sind an diesen Abwicklungen nicht möglich und entfallen."],
  group_size: ["Size", "Größe"],
  group_paper: ["Paper", "Papier"],
  group_pieces: ["Pieces", "Teile"],
  group_tabs: ["Tabs and lines", "Laschen und Linien"],
  group_machine: ["Machines and searches", "Maschinen und Suche"],
  cancel: ["Cancel", "Abbrechen"],
  cancelled: ["Cancelled. Showing the previous result.", "Abgebrochen. Zu sehen ist das vorige Ergebnis."],
  starting: ["Starting …", "Startet …"],
  notes_list: ["About the model", "Zum Modell"],
  no_program: ["This browser can't run the program in this page: it needs Chrome 95, Firefox 113, Safari 16.4 or newer ({why}).", "Dieser Browser kann das Programm dieser Seite nicht ausführen: Nötig ist Chrome 95, Firefox 113, Safari 16.4 oder neuer ({why})."],
  several_models: ["There are several models among these files; {name} was opened.", "Unter diesen Dateien sind mehrere Modelle; {name} wurde geöffnet."],
  no_model: ["None of these files is a model that can be read.", "Keine dieser Dateien ist ein lesbares Modell."],
  too_large: ["The model needs more memory than a browser gives a page.", "Das Modell braucht mehr Speicher, als ein Browser einer Seite gibt."],
  stopped: ["The program stopped: {why}", "Das Programm ist stehengeblieben: {why}"],
  stage_reading: ["Reading", "Lesen"],
  stage_repairing: ["Reading", "Lesen"],
  stage_read: ["Reading", "Lesen"],
  stage_preparing: ["Making it ready for paper", "Für Papier vorbereiten"],
  stage_simplifying: ["Making it ready for paper", "Für Papier vorbereiten"],
  stage_tabs: ["Setting tabs", "Laschen setzen"],
  stage_prepare: ["Making it ready for paper", "Für Papier vorbereiten"],
  stage_segment: ["Finding its parts", "Körperteile finden"],
  stage_unfold: ["Unfolding", "Abwickeln"],
  stage_lay_out: ["Filling the sheets", "Bögen füllen"],
  stage_hint: ["Filling the sheets", "Bögen füllen"],
  stage_draw: ["Drawing", "Zeichnen"],
  stage_guide: ["Drawing how it is built", "Bauanleitung zeichnen"],
  stage_verify: ["Checking", "Prüfen"],
  stage_write: ["Writing", "Schreiben"],
});

/** A message as a sentence of its own. Names of files keep their letters. @param {Message} message */
export function saySentence(message) {
  const sentence = sayMessage(message);
  return messages[message.code]?.[0].startsWith("{") ?? true ? sentence : `${sentence.charAt(0).toUpperCase()}${sentence.slice(1)}.`;
}

/** The option that a message proposes; null where it proposes none. @param {Message} message
 * @returns {{option: string, value: string} | null} */
export function proposalOf({values}) {
  const proposed = values.try;
  if (typeof proposed === "object" && !Array.isArray(proposed)) {
    return proposed;
  }
  return Object.values(values).filter(Array.isArray).flat().map((item) => (typeof item === "string" ? null : proposalOf(item)))
    .find((one) => one !== null) ?? null;
}
