// Tables: a click on a heading sorts the rows by its column, and another click turns the order round.
"use strict";
for (const table of document.querySelectorAll("table")) {
    const body = table.tBodies[0];
    const headings = [...table.tHead.rows[0].cells];

    function compare(a, b, column) {
        const [x, y] = [a, b].map((row) => row.cells[column]);
        if (x.dataset.value === undefined || y.dataset.value === undefined) return x.textContent.localeCompare(y.textContent);
        return Number(x.dataset.value) - Number(y.dataset.value);
    }
    const missing = (row, column) => row.cells[column].dataset.value === "NaN";

    headings.forEach((heading, column) => {
        heading.querySelector("button").addEventListener("click", () => {
            const before = heading.getAttribute("aria-sort");
            const start = heading.dataset.from === "highest" ? "descending" : "ascending";
            const order = before === null ? start : before === "ascending" ? "descending" : "ascending";
            for (const other of headings) other.removeAttribute("aria-sort");
            heading.setAttribute("aria-sort", order);
            const sign = order === "ascending" ? 1 : -1;
            // What was not measured comes last either way.
            const rows = [...body.rows].sort(
                (a, b) => missing(a, column) - missing(b, column) || (missing(a, column) ? 0 : sign * compare(a, b, column)),
            );
            body.append(...rows);
        });
    });
}
