;;; test.el --- A finding appears in Emacs by eglot  -*- lexical-binding: t; -*-

;; emacs --batch -l test.el, from a folder of programs. GCHECK_PATH names the program, GCHECK_PLUGIN the folder of gcheck.el.

(require 'package)
(package-initialize)
(load (expand-file-name "gcheck.el" (getenv "GCHECK_PLUGIN")))
(require 'eglot)
(require 'flymake)

(setq eglot-sync-connect t
      eglot-autoshutdown t)

(defun until (what ask)
  "Wait until ASK says yes; complain that WHAT did not come."
  (let ((end (+ (float-time) 30)) (answer nil))
    (while (and (not (setq answer (funcall ask))) (< (float-time) end))
      (accept-process-output nil 0.05))
    (or answer (error "Waited in vain for %s" what))))

(with-current-buffer (find-file-noselect "part.nc")
  (unless (eq major-mode 'gcode-mode) (error "part.nc is %s" major-mode))
  (call-process "git" nil nil nil "init" "-q")
  (apply #'eglot (eglot--guess-contact))
  (flymake-mode 1)
  (let* ((of-rule (lambda (diagnostic) (string-match-p "unknown-code" (flymake-diagnostic-text diagnostic))))
         (found (until "the finding"
                       (lambda ()
                         (flymake-start)
                         (seq-find of-rule (flymake-diagnostics))))))
    (unless (= 6 (line-number-at-pos (flymake-diagnostic-beg found)))
      (error "The finding is on line %s" (line-number-at-pos (flymake-diagnostic-beg found))))
    (message "ok a finding appears: %s" (flymake-diagnostic-text found)))
  (eglot-shutdown (eglot-current-server)))

(with-temp-file "gcheck.toml"
  (insert "control = \"haas-mill\"\n[machine]\nunits = \"inches\"\n"))
(with-current-buffer (find-file-noselect "gcheck.toml")
  (unless (eq major-mode 'gcheck-toml-mode) (error "gcheck.toml is %s" major-mode))
  (apply #'eglot (eglot--guess-contact))
  (flymake-mode 1)
  (let ((found (until "the finding in gcheck.toml"
                      (lambda ()
                        (flymake-start)
                        (seq-find (lambda (one) (string-match-p "unknown value" (flymake-diagnostic-text one)))
                                  (flymake-diagnostics))))))
    (unless (= 3 (line-number-at-pos (flymake-diagnostic-beg found)))
      (error "The finding is on line %s" (line-number-at-pos (flymake-diagnostic-beg found))))
    (message "ok a finding appears in gcheck.toml: %s" (flymake-diagnostic-text found)))
  (eglot-shutdown (eglot-current-server)))
(message "all tests passed")
