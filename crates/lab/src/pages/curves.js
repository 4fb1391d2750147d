// Curves: the legend hides lines, and says their values at the frame under the pointer.
"use strict";
for (const figure of document.querySelectorAll("figure.curves")) {
    const plot = figure.querySelector(".plot");
    const cursor = figure.querySelector(".cursor");
    const across = figure.querySelector(".across");
    const first = Number(figure.dataset.first);
    const last = Number(figure.dataset.count) - 1;
    const lines = figure.querySelectorAll("g.series");
    const entries = [...figure.querySelectorAll(".legend button")].map((button) => ({
        button,
        value: button.querySelector(".value"),
        // A gap is empty in the list.
        values: button.dataset.values.split(",").map((text) => (text === "" ? NaN : Number(text))),
    }));

    entries.forEach(({ button }, i) => {
        button.addEventListener("click", () => {
            const shown = button.getAttribute("aria-pressed") !== "true";
            button.setAttribute("aria-pressed", shown);
            lines[i].classList.toggle("off", !shown);
        });
    });

    let frame = null;
    function look(at) {
        frame = at === null ? null : Math.min(last, Math.max(0, at));
        cursor.hidden = frame === null;
        across.textContent = frame === null ? "frame" : "frame " + (first + frame);
        if (frame !== null) cursor.style.left = (last > 0 ? (100 * frame) / last : 50) + "%";
        for (const { value, values } of entries) {
            const number = frame === null ? NaN : values[frame] ?? NaN;
            value.textContent = frame === null ? "" : Number.isNaN(number) ? "–" : Number(number.toPrecision(4));
        }
    }
    plot.addEventListener("pointermove", (event) => {
        const box = plot.getBoundingClientRect();
        look(Math.round((last * (event.clientX - box.left)) / box.width));
    });
    plot.addEventListener("pointerleave", () => look(null));
    plot.addEventListener("blur", () => look(null));
    plot.addEventListener("keydown", (event) => {
        const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        look(frame === null ? (step > 0 ? 0 : last) : frame + step);
    });
}
