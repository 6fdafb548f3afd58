// SPDX-License-Identifier: Apache-2.0
// The frames of a list as a job of Flamenco 3: put this file into the folder `scripts` beside flamenco-manager.
// A task renders a chunk of the frames; what was rendered before stays, so a task that failed is simply run again.

const JOB_TYPE = {
  label: "Vitrail Frames",
  settings: [
    { key: "bundle", type: "string", subtype: "dir_path", required: true, description: "What vitrail partition wrote" },
    { key: "list", type: "string", subtype: "file_path", required: true, description: "A line of options for each frame" },
    { key: "frames", type: "string", required: true, default: "1-100", description: "Numbers of lines: 47, 1-30,47" },
    { key: "output", type: "string", required: true, description: "The pictures, with a place for the number: day%04d.png" },
    { key: "chunk_size", type: "int32", default: 1, description: "Frames of a task" },
    { key: "options", type: "string", default: "--retries 2", description: "Further options of vitrail render" },
    { key: "vitrail", type: "string", default: "vitrail", description: "The program, as workers find it" },
  ],
};

function compileJob(job) {
  const settings = job.settings;
  const options = settings.options.split(" ").filter((word) => word.length > 0);
  for (const chunk of frameChunker(settings.frames, settings.chunk_size)) {
    const task = author.Task(`frames ${chunk}`, "misc");
    task.addCommand(author.Command("exec", {
      exe: settings.vitrail,
      args: ["render", settings.bundle, "--frames", settings.list, "-o", settings.output, "--range", chunk].concat(options),
    }));
    job.addTask(task);
  }
}
