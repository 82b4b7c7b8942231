;;; test.el --- gcheck in Emacs, with eglot  -*- lexical-binding: t; -*-

;; emacs --batch -l test.el, from a folder of programs. GCHECK_PATH names the program, GCHECK_PLUGIN the folder of gcheck.el.

(require 'package)
(package-initialize)
(load (expand-file-name "gcheck.el" (getenv "GCHECK_PLUGIN")))
(require 'eglot)
(require 'flymake)

(setq eglot-sync-connect t
      eglot-autoshutdown t)

(defvar failed 0)

(defmacro check (name &rest body)
  "Run BODY, and say under NAME whether it failed."
  `(condition-case problem
       (progn ,@body (message "ok %s" ,name))
     (error (setq failed (1+ failed))
            (message "FAILED %s: %s" ,name (error-message-string problem)))))

(defun until (what ask)
  "Wait until ASK says yes; complain that WHAT did not come."
  (let ((end (+ (float-time) 30)) (answer nil))
    (while (and (not (setq answer (funcall ask))) (< (float-time) end))
      (accept-process-output nil 0.05))
    (or answer (error "Waited in vain for %s" what))))

(defun must (what is expected)
  "Complain unless WHAT IS as EXPECTED."
  (unless (equal is expected) (error "%s is %S, not %S" what is expected)))

(defun connect ()
  "Start the server for the buffer."
  (apply #'eglot (eglot--guess-contact))
  (flymake-mode 1))

(defun found (pattern)
  "The finding whose text fits PATTERN, when it comes."
  (until pattern
         (lambda ()
           (flymake-start)
           (seq-find (lambda (one) (string-match-p pattern (flymake-diagnostic-text one)))
                     (flymake-diagnostics)))))

(defun ask (method)
  "The answer of the server to METHOD at the cursor."
  (jsonrpc-request (eglot-current-server) method (eglot--TextDocumentPositionParams)))

(call-process "git" nil nil nil "init" "-q")

(check "words have faces by their role in gcode-mode"
  (with-temp-buffer
    (insert "%\nO1234 (PART)\nN10 G00X1. G01Y2. G2 X3. I1. G10 L2 M06 T5 S900\nG01.5 #100=#<deep>\nWHILE [#1 LT 2] DO1\ng0 x1\n")
    (gcode-mode)
    (font-lock-ensure)
    (let ((face (lambda (text)
                  (goto-char (point-min))
                  (search-forward text)
                  (let ((face (get-text-property (match-beginning 0) 'face)))
                    (if (consp face) (car face) face)))))
      (dolist (pair '(("G00" . gcode-rapid) ("G01Y" . gcode-feed) ("G2 " . gcode-arc) ("G10" . gcode-code)
                      ("G01.5" . gcode-code) ("M06" . gcode-code) ("T5" . gcode-tool) ("S900" . gcode-tool)
                      ("N10" . gcode-label) ("O1234" . gcode-program) ("%" . gcode-program)
                      ("#100" . gcode-variable) ("#<deep>" . gcode-variable) ("WHILE" . gcode-flow)
                      ("DO1" . gcode-flow) ("g0" . gcode-rapid) ("(PART" . font-lock-comment-face)))
        (let ((is (funcall face (car pair))))
          (unless (or (eq is (cdr pair)) (and (eq is 'font-lock-comment-delimiter-face) (eq (cdr pair) 'font-lock-comment-face)))
            (error "%s has %S" (car pair) is))))
      (let ((roles '(gcode-rapid gcode-feed gcode-arc gcode-code)))
        (must "the number of looks"
              (length (delete-dups (mapcar (lambda (role) (face-attribute role :inherit)) roles)))
              (length roles))))))

(check "a finding appears, by the program of gcheck-command"
  (must "the command" gcheck-command (list (getenv "GCHECK_PATH") "lsp"))
  (with-current-buffer (find-file-noselect "part.nc")
    (must "the mode of part.nc" major-mode 'gcode-mode)
    (connect)
    (must "the line of the finding" (line-number-at-pos (flymake-diagnostic-beg (found "unknown-code"))) 6)))

(check "hover tells the state, and completion offers codes"
  (with-current-buffer (find-file-noselect "part.nc")
    (goto-char (point-min))
    (search-forward "G43")
    (backward-char)
    ;; The cursor is after `G4`, so the codes that begin so are offered.
    (let ((text (plist-get (plist-get (ask :textDocument/hover) :contents) :value)))
      (unless (string-match-p "G43" text) (error "Hover says %s" text))
      (unless (string-match-p "in effect" text) (error "Hover does not tell the state: %s" text)))
    (let* ((list (ask :textDocument/completion))
           (labels (mapcar (lambda (item) (plist-get item :label)) (plist-get list :items))))
      (unless (seq-find (lambda (label) (string-prefix-p "G49" label)) labels)
        (error "The list has %S" (seq-take labels 20))))))

(check "a fix is an action, and clears its finding"
  (with-current-buffer (find-file-noselect "fixable.nc")
    (connect)
    (let ((one (found "code-given-twice")))
      (goto-char (flymake-diagnostic-beg one))
      (let* ((actions (eglot-code-actions (flymake-diagnostic-beg one) (flymake-diagnostic-end one)))
             (fix (seq-find (lambda (action) (string-prefix-p "Remove the second" (plist-get action :title))) actions)))
        (unless fix (error "There are %S" (mapcar (lambda (action) (plist-get action :title)) actions)))
        (eglot--apply-workspace-edit (plist-get fix :edit))
        ;; Without a person no idle moment comes in which the change is told.
        (eglot--signal-textDocument/didChange)))
    (until "the finding to go"
           (lambda ()
             (flymake-start)
             (not (seq-find (lambda (one) (string-match-p "code-given-twice" (flymake-diagnostic-text one)))
                            (flymake-diagnostics)))))
    (set-buffer-modified-p nil)
    (eglot-shutdown (eglot-current-server))))

(with-temp-file "gcheck.toml"
  (insert "control = \"haas-mill\"\n[machine]\nunits = \"inches\"\n"))

(check "gcheck.toml has findings in gcheck-toml-mode"
  (with-current-buffer (find-file-noselect "gcheck.toml")
    (must "the mode of gcheck.toml" major-mode 'gcheck-toml-mode)
    (connect)
    (must "the line of the finding" (line-number-at-pos (flymake-diagnostic-beg (found "unknown value"))) 3)
    (eglot-shutdown (eglot-current-server))))

(if (= failed 0)
    (message "all tests passed")
  (message "%d tests failed" failed)
  (kill-emacs 1))
