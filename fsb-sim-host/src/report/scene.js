// Turns the large view of a scene with the pointer: left and right about the vertical, up and down for the elevation.
for (const group of document.querySelectorAll("g.turns")) {
  const [cx, cy, scale, mx, my, mz, azimuth, elevation] = group.dataset.view.split(" ").map(Number);
  let [a, e, held] = [azimuth, elevation, null];
  const parts = Array.from(group.querySelectorAll("[data-p]"), (element) => {
    const numbers = element.dataset.p.trim().split(" ").map(Number);
    const points = [];
    while (numbers.length) points.push(numbers.splice(0, 3));
    return [element, points];
  });
  const onPage = ([x, y, z]) => {
    const [dx, dy, dz] = [x - mx, y - my, z - mz];
    const u = dy * Math.cos(a) - dx * Math.sin(a);
    const v = dz * Math.cos(e) - Math.sin(e) * (dx * Math.cos(a) + dy * Math.sin(a));
    return [(cx + scale * u).toFixed(1), (cy - scale * v).toFixed(1)];
  };
  const draw = () => parts.forEach(([element, points]) => {
    if (element.tagName === "text") {
      const [x, y] = onPage(points[0]);
      element.setAttribute("x", x);
      element.setAttribute("y", y);
    } else {
      element.setAttribute("points", points.map((p) => onPage(p).join(",")).join(" "));
    }
  });
  group.style.cursor = "grab";
  group.style.touchAction = "none";
  group.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    group.setPointerCapture(event.pointerId);
  });
  group.addEventListener("pointerup", () => { held = null; });
  group.addEventListener("pointermove", (event) => {
    if (held === null) return;
    a -= (event.clientX - held[0]) * 0.01;
    e = Math.max(-1.57, Math.min(1.57, e + (event.clientY - held[1]) * 0.01));
    held = [event.clientX, event.clientY];
    draw();
  });
}
