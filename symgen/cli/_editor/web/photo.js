// -- a picture of the sketch behind the drawing ---------------------------------------------------------------------------

// Where its lower left corner is, and how wide it is [m]; it stays in this page and is sent nowhere.
let photo = null;
const sketched = element("img"), chosenFile = element("input"), photoBox = element("span", "", "photo"), photoPlace = element("input"), photoButton = element("button", "Photo");
sketched.id = "photo";
sketched.alt = "";
Object.assign(chosenFile, { type: "file", accept: "image/*", hidden: true, id: "chosen" });
chosenFile.setAttribute("aria-label", "Picture of the sketch");
photoButton.title = "Put a picture of the sketch behind the drawing";
photoPlace.id = "photoPlace";
photoPlace.hidden = true;
photoPlace.setAttribute("aria-label", "Picture: x, y of its lower left corner and its width in metres, Enter");
photoPlace.title = photoPlace.getAttribute("aria-label");
photoBox.append(photoButton, chosenFile, photoPlace);
bench.append(photoBox);
$("picture").insertBefore(sketched, layer); // the canvas is opaque
sketched.hidden = true;

photoButton.addEventListener("click", () => {
  if (!photo) return chosenFile.click();
  URL.revokeObjectURL(sketched.src);
  photo = null;
  sketched.hidden = photoPlace.hidden = true;
  sketched.removeAttribute("src");
  photoButton.textContent = "Photo";
});
chosenFile.addEventListener("change", () => {
  const [file] = chosenFile.files;
  chosenFile.value = "";
  if (file) sketched.src = URL.createObjectURL(file);
});
sketched.addEventListener("load", () => {
  const [left, top] = onPlane(0, 0), [right, low] = onPlane(view.camera.width, view.camera.height);
  const ratio = sketched.naturalHeight / sketched.naturalWidth || 1, width = Math.min(right - left, (top - low) / ratio);
  photo = { x: 0.5 * (left + right - width), y: 0.5 * (top + low - ratio * width), width };
  sketched.hidden = photoPlace.hidden = false;
  photoButton.textContent = "No photo";
  writePhoto();
});
sketched.addEventListener("error", () => sketched.getAttribute("src") && say("this file is no picture that the browser shows", true));

const writePhoto = () => {
  photoPlace.value = [photo.x, photo.y, photo.width].map((x) => +x.toPrecision(4)).join(", ");
  wanted = true;
};
photoPlace.addEventListener("keydown", (e) => {
  if (e.key !== "Enter") return;
  const [x, y, width] = photoPlace.value.split(",").map(Number);
  if (![x, y, width].every(Number.isFinite) || !(width > 0)) return say("expected x, y, width in metres, such as -0.5, 0, 2", true);
  photo = { x, y, width };
  writePhoto();
});

drawn.push(() => {
  if (!photo) return;
  sketched.hidden = view.spatial;
  const height = (photo.width * sketched.naturalHeight) / sketched.naturalWidth, [left, top] = onPicture(photo.x, photo.y + height);
  sketched.style.left = `${left}px`;
  sketched.style.top = `${top}px`;
  sketched.style.width = `${photo.width * view.camera.scale}px`;
});
