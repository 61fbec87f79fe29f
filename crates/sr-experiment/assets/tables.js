// Tables that sort: a click or Enter on a heading, and again for the other direction.

const startTables = () => {
  for (const table of document.querySelectorAll("table.sortable")) {
    const body = table.tBodies[0];
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      const text = head.textContent;
      head.replaceChildren(button(text, () => sort(table, body, heads, column)));
    });
  }
};

const sort = (table, body, heads, column) => {
  const ascending = heads[column].getAttribute("aria-sort") !== "ascending";
  heads.forEach((h) => h.removeAttribute("aria-sort"));
  heads[column].setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const sign = ascending ? 1 : -1;
  const rows = [...body.rows].map((row) => {
    const cell = row.cells[column];
    const key = "key" in cell.dataset ? Number(cell.dataset.key) : null;
    return { row, key, text: cell.textContent };
  });
  rows.sort((a, b) => {
    // What is not known comes last either way.
    if ((a.text === "–") !== (b.text === "–")) return a.text === "–" ? 1 : -1;
    if (a.key !== null && b.key !== null) return sign * (a.key - b.key);
    return sign * a.text.localeCompare(b.text, undefined, { numeric: true });
  });
  body.append(...rows.map((r) => r.row));
};
