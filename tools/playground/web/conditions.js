// Sliders of physics and senses: name, unit, range, and the numbers of the module that they set.

const SLIDERS = [
  { id: "rolling", name: "Rolling friction", unit: "×", low: 0.2, high: 4, step: 0.1, ideal: 1, ball: ["rolling_deceleration"] },
  { id: "bounce", name: "Bounce of walls", unit: "×", low: 0.2, high: 1.5, step: 0.1, ideal: 1, ball: ["wall_restitution"] },
  { id: "traction", name: "Traction", unit: "×", low: 0.2, high: 2, step: 0.1, ideal: 1, robots: ["traction"] },
  { id: "speed", name: "Robot speed", unit: "×", low: 0.3, high: 1.5, step: 0.1, ideal: 1, robots: ["speed"] },
  { id: "delay", name: "Vision delay", unit: "ms", low: 0, high: 200, step: 5, ideal: 0, scale: 1e-3, sensing: ["delay"], vision: true },
  { id: "command", name: "Command delay", unit: "ms", low: 0, high: 150, step: 5, ideal: 0, scale: 1e-3, sensing: ["command_delay"] },
  { id: "noise", name: "Position noise", unit: "mm", low: 0, high: 30, step: 1, ideal: 0, scale: 1e-3, sensing: ["ball_position_noise", "robot_position_noise"], vision: true },
  { id: "loss", name: "Lost frames", unit: "%", low: 0, high: 60, step: 5, ideal: 0, scale: 1e-2, sensing: ["frame_loss"], vision: true },
  { id: "radio", name: "Lost commands", unit: "%", low: 0, high: 60, step: 5, ideal: 0, scale: 1e-2, sensing: ["command_loss"] },
];

/** Whether a slider of vision is off its ideal. */
function seesThroughCameras(values) {
  return SLIDERS.some(({ id, ideal, vision }) => vision && (values[id] ?? ideal) !== ideal);
}

/** Conditions of a match, for the module, from values by id. */
function conditionsOf(values) {
  const conditions = { ball: {}, robots: {}, sensing: {} };
  for (const slider of SLIDERS) {
    const value = values[slider.id] ?? slider.ideal;
    if (value === slider.ideal) continue;
    for (const part of ["ball", "robots", "sensing"]) {
      for (const name of slider[part] ?? []) conditions[part][name] = value * (slider.scale ?? 1);
    }
  }
  // Noise needs a filter: without one velocities would be true, as if measured exactly. Limits of
  // commands alone leave the true state to the robots.
  if (seesThroughCameras(values)) {
    Object.assign(conditions.sensing, { frame_rate: 60, tracker: 1 });
  }
  return conditions;
}

/** The panel of sliders. */
class ConditionsPanel {
  constructor(parent, changed) {
    this.values = {};
    this.rows = SLIDERS.map((slider) => {
      const input = Object.assign(document.createElement("input"), {
        type: "range", min: slider.low, max: slider.high, step: slider.step, value: slider.ideal, id: `slider-${slider.id}`,
      });
      const output = document.createElement("output");
      const label = newElement("label", "row", slider.name, input, output);
      input.addEventListener("input", () => {
        this.values[slider.id] = Number(input.value);
        this.show();
      });
      input.addEventListener("change", () => changed());
      parent.append(label);
      return { slider, input, output, label };
    });
    this.show();
  }

  set(values) {
    this.values = { ...values };
    this.show();
  }

  show() {
    for (const { slider, input, output, label } of this.rows) {
      const value = this.values[slider.id] ?? slider.ideal;
      input.value = value;
      output.textContent = `${slider.unit === "×" ? value.toFixed(1) : value} ${slider.unit}`;
      label.classList.toggle("changed", value !== slider.ideal);
    }
  }
}
