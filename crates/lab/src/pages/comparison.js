// Two pictures in one place: which are shown, where the left one ends, and how large they are.
"use strict";
for (const figure of document.querySelectorAll("figure.comparison")) {
    const find = (selector) => figure.querySelector(selector);
    const [viewport, stage, split, handle] = [".viewport", ".stage", ".split", ".handle"].map(find);
    const [left, right, zoom] = [".choose-left", ".choose-right", ".zoom"].map(find);
    const layers = [...figure.querySelectorAll(".layer")];

    function choose() {
        const chosen = [Number(left.value), Number(right.value)];
        layers.forEach((layer, i) => {
            layer.classList.toggle("left", i === chosen[0]);
            layer.classList.toggle("right", i === chosen[1]);
        });
        find(".tag.of-left").textContent = layers[chosen[0]].alt;
        find(".tag.of-right").textContent = layers[chosen[1]].alt;
        for (const bar of figure.querySelectorAll(".colour-bar")) {
            bar.hidden = !chosen.includes(Number(bar.dataset.layer));
        }
    }
    left.addEventListener("change", choose);
    right.addEventListener("change", choose);

    let percent = 50;
    function move(to) {
        percent = Math.min(100, Math.max(0, to));
        stage.style.setProperty("--split", percent + "%");
        split.value = percent;
    }
    // Arrow keys come this way. The pointer has its own: it would be held to the whole steps of the keys.
    split.addEventListener("input", () => move(Number(split.value)));

    const follow = (event) => {
        const box = stage.getBoundingClientRect();
        move((100 * (event.clientX - box.left)) / box.width);
    };
    let dragged = false;
    stage.addEventListener("pointerdown", (event) => {
        // A finger beside the handle scrolls, and moves the handle when it only taps.
        if (event.button !== 0 || (event.pointerType === "touch" && event.target !== handle)) return;
        dragged = true;
        stage.setPointerCapture(event.pointerId);
        event.preventDefault();
        split.focus({ preventScroll: true });
        follow(event);
    });
    stage.addEventListener("pointermove", (event) => dragged && follow(event));
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => (dragged = false));
    stage.addEventListener("click", (event) => event.target !== handle && follow(event));

    zoom.addEventListener("change", () => {
        const middle = (viewport.scrollTop + viewport.clientHeight / 2) / stage.clientHeight;
        const factor = Number(zoom.value);
        stage.classList.toggle("enlarged", factor > 0);
        stage.style.width = factor > 0 ? factor * Number(stage.dataset.width) + "px" : "";
        // What was compared stays in view: the handle, at the same height.
        viewport.scrollLeft = (percent / 100) * stage.clientWidth - viewport.clientWidth / 2;
        viewport.scrollTop = middle * stage.clientHeight - viewport.clientHeight / 2;
    });
}
