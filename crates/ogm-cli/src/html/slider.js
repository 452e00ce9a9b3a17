const stack = document.querySelector(".stack");
if (stack) {
  const layers = [...stack.querySelectorAll("img")];
  const edge = stack.querySelector(".edge");
  const [left, right, slider, both] = ["left", "right", "slider", "both"].map((id) => document.getElementById(id));
  const draw = () => {
    stack.classList.toggle("both", both.checked);
    layers.forEach((layer, place) => {
      const chosen = { left: place === Number(left.value), right: place === Number(right.value) };
      layer.style.visibility = both.checked || chosen.left || chosen.right ? "" : "hidden";
      layer.style.zIndex = chosen.right ? 1 : 0;
      layer.style.clipPath = both.checked || !chosen.right || chosen.left ? "" : `inset(0 0 0 ${slider.value}%)`;
    });
    edge.style.left = `${slider.value}%`;
  };
  for (const control of [left, right, slider]) {
    control.addEventListener("input", () => { both.checked = false; draw(); });
  }
  both.addEventListener("change", draw);
  draw();
}
